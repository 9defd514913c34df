#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Picture picture_convergence(const PictureSources& from) { return convergence_picture(from.view); }

}  // namespace gyrostat
