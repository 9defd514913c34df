#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// The clock of a sensor beside that of a recorder which writes its last value again until there is
/// a new one.
struct SlowerClock {
  static constexpr double uncertain = 0.01;  ///< of a turn, which the clocks may be apart

  double samples = 1.0;   ///< of the recorder from one new value to the next
  double middle = 0.0;    ///< of the turns at which values are new, in turns
  double youngest = 0.0;  ///< turns after the middle (below 0) at which they are just new

  /// How far a sample is, in turns, after the middle of where values are new.
  double off(std::size_t sample) const;
  /// Where a value that is the one before again is so by chance.
  bool is_new_at(std::size_t sample) const {
    return std::abs(off(sample)) < 0.5 / samples - uncertain;
  }
  /// Of a new value, how many samples ago it was measured: 0 to 1. Where the clocks' ratio is that
  /// of small numbers, new values are of a few ages only; the youngest is none.
  double age(std::size_t sample) const {
    return std::clamp(samples * (off(sample) - youngest), 0.0, 1.0);
  }
};

/// Where nearly all values that differ from the one before stand where such a clock has new ones:
/// the slowest that has, by the lines of their spectrum. None where values repeat otherwise, or
/// change as slowly as a motion does.
std::optional<SlowerClock> slower_clock(const Conditions& conditions,
                                        const std::vector<double>& gyro_dps);

}  // namespace gyrostat::gap
