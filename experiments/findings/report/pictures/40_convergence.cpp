#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_convergence(const PictureSources& from) { return convergence_chart(from.view); }

}  // namespace gyrostat
