#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_consistency(const PictureSources& from) { return consistency_chart(from.view); }

}  // namespace gyrostat
