#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_speed(const PictureSources& from) {
  return speed_picture(from.view, from.nanoseconds);
}

}  // namespace gyrostat
