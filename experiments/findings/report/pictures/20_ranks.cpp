#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {

Chart picture_ranks(const PictureSources& from) { return rank_chart(from.view, from.ranking); }

}  // namespace gyrostat
