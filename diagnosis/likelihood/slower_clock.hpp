#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// The clock of a sensor beside that of a recorder which writes its last value again until there is
/// a new one.
struct SlowerClock {
  double samples = 1.0;  ///< of the recorder from one new value to the next
  double middle = 0.0;   ///< of the turns at which values are new, in turns

  /// How far a sample is, in turns, from the middle of where values are new.
  double off(std::size_t sample) const;
  bool is_new_at(std::size_t sample) const { return off(sample) < 0.5 / samples; }
};

/// Where nearly all values that differ from the one before stand where such a clock has new ones:
/// the slowest that has, by the lines of their spectrum. None where values repeat otherwise, or
/// change as slowly as a motion does.
std::optional<SlowerClock> slower_clock(const Conditions& conditions,
                                        const std::vector<double>& gyro_dps);

}  // namespace gyrostat::gap
