#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_heading(const PictureSources& from) {
  return from.replayed.trials > 0 ? heading_picture(from.view, from.replayed) : Picture{};
}

}  // namespace gyrostat
