#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_allan(const PictureSources& from) {
  return from.replayed.trials > 0 ? allan_chart(from.view, from.replayed) : Chart{};
}

}  // namespace gyrostat
