#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_consistency(const PictureSources& from) { return consistency_picture(from.view); }

}  // namespace gyrostat
