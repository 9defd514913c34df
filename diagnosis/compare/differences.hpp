#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gyrostat/diagnosis/compare/matched.hpp>
#include <gyrostat/diagnosis/compare/studied_side.hpp>

namespace gyrostat::gap {

/// How a difference is decided.
struct DifferenceOptions {
  std::uint64_t seed = 1;
  double level = 0.01;
  /// Segments differ, so there is a difference: an effect is named without paying for the others.
  bool segments_differ = false;
  Interrupt interrupt = {};
  std::function<void(const std::string& effect, double share)> progress = {};
};

struct Differences {
  std::vector<Difference> found;
  std::vector<Undecided> undecided;
};

/// The effects and noises in which the sides differ, as `compare` says.
Differences differences_between(const StudiedSide& real, const StudiedSide& simulated,
                                const Matched& matched, const DifferenceOptions& options);

}  // namespace gyrostat::gap
