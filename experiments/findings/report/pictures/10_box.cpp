#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_box(const PictureSources& from) { return box_chart(from.view); }

}  // namespace gyrostat
