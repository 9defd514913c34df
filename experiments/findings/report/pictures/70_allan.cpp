#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_allan(const PictureSources& from) {
  return from.replayed.trials > 0 ? allan_picture(from.view, from.replayed) : Picture{};
}

}  // namespace gyrostat
