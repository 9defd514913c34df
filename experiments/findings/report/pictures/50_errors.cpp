#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_errors(const PictureSources& from) {
  return from.replayed.trials > 0 ? error_chart(from.view, from.replayed) : Chart{};
}

}  // namespace gyrostat
