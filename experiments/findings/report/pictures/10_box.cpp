#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_box(const PictureSources& from) { return box_picture(from.view); }

}  // namespace gyrostat
