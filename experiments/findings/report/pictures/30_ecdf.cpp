#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_ecdf(const PictureSources& from) { return ecdf_picture(from.view); }

}  // namespace gyrostat
