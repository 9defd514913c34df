#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_speed(const PictureSources& from) { return speed_chart(from.view, from.nanoseconds); }

}  // namespace gyrostat
