#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/start_up.hpp>

namespace gyrostat::gap {

/// An exponential from the first sample on.
template <>
struct Diagnosed<effects::StartUp> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {&effects::StartUp::amplitude_dps,
                                                 &effects::StartUp::settling_time_s};

  static std::vector<effects::StartUp> guesses(const Beside& beside) {
    std::vector<effects::StartUp> all;
    for (const double memory_s : beside.memories_s()) all.push_back({1.0, memory_s});
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// It has settled to 5 %: else it were a ramp.
  static bool is_what_it_is_called(const effects::StartUp& effect, const Conditions& c) {
    return 3.0 * effect.settling_time_s < duration_s(c);
  }

 private:
  static double duration_s(const Conditions& c) {
    return c.slow_interval_s() * static_cast<double>(c.slow_size());
  }
};

}  // namespace gyrostat::gap
