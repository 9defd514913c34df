#pragma once

#include <map>
#include <string>
#include <vector>

#include <gyrostat/experiments/findings/report/cell_view.hpp>

namespace gyrostat {

/// What the pictures of one cell may be made from.
struct PictureSources {
  const CellView& view;
  const CellRanking& ranking;
  const Replayed& replayed;  ///< without trials where none were simulated again
  const std::map<std::string, double>& nanoseconds;  ///< per step, by method
};

/// One picture from each file of pictures/, in the order of their numbers; one without marks has
/// nothing to show.
///
/// A file NN_<name>.cpp defines `Picture picture_<name>(const PictureSources&)`.
void append_pictures(const PictureSources& from, std::vector<Picture>& to);

}  // namespace gyrostat
