#pragma once

#include <string>
#include <vector>

#include <gyrostat/diagnosis/compare/comparison.hpp>

namespace gyrostat::gap {

/// How traces of both sides are compared that were made alike.
struct Matched {
  double rate_hz = 0.0;
  std::size_t segment = 0;           ///< samples of a segment, an eighth of the shortest trace
  std::size_t piece = 0;             ///< of a piece of a held-out part
  std::vector<std::string> without;  ///< effects that are not looked for
  std::vector<Shortfall> not_assessable;
  double compared = 1.0;  ///< effects, and two noises

  double segment_s() const { return static_cast<double>(segment) / rate_hz; }
};

/// Throws InputError where traces cannot be compared, as `compare` says.
Matched match(const std::vector<NamedSeries>& recordings, const std::vector<NamedSeries>& simulated,
              std::vector<std::string> without);

}  // namespace gyrostat::gap
