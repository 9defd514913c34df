#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_heading(const PictureSources& from) {
  return from.replayed.trials > 0 ? heading_chart(from.view, from.replayed) : Chart{};
}

}  // namespace gyrostat
