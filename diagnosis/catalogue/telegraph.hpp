#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/slow_noise.hpp>
#include <gyrostat/generators/effects/telegraph.hpp>

namespace gyrostat::gap {

/// The Allan variance is that of a Gauss-Markov process; the two levels are seen by their
/// shape.
template <>
struct Diagnosed<effects::Telegraph> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::Telegraph::amplitude_dps,
                                                 &effects::Telegraph::mean_dwell_s};

  static std::vector<Start> starts(const Evidence& e) {
    return slow_noise(e, SlowComponent::gauss_markov, [](const auto& fit) {
      return effects::Telegraph{fit.slow_std_dps, 2.0 * fit.correlation_time_s};
    });
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Telegraph& effect, const Conditions& c) {
    const double duration_s = c.interval_s() * static_cast<double>(c.size());
    return is_slow(effect.mean_dwell_s, c) && effect.mean_dwell_s < duration_s / 10.0;
  }
};

}  // namespace gyrostat::gap
