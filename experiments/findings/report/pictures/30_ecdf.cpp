#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_ecdf(const PictureSources& from) { return ecdf_chart(from.view); }

}  // namespace gyrostat
