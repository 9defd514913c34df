#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_errors(const PictureSources& from) {
  return from.replayed.trials > 0 ? error_picture(from.view, from.replayed) : Picture{};
}

}  // namespace gyrostat
