#include <gyrostat/experiments/findings/report/picture.hpp>
#include <gyrostat/experiments/findings/report/rank_picture.hpp>

namespace gyrostat {

Picture picture_ranks(const PictureSources& from) {
  return rank_picture(from.ranking, from.view.colours, from.view.id + "-ranks");
}

}  // namespace gyrostat
