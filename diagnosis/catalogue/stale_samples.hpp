#pragma once

#include <algorithm>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/generators/effects/stale_samples.hpp>

namespace gyrostat::gap {

/// Values that repeat the one before, and those that repeat two.
template <>
struct Diagnosed<effects::StaleSamples> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::StaleSamples::probability,
                                                 &effects::StaleSamples::mean_run};

  static std::vector<Start> starts(const Evidence& e) {
    double count = 0.0, pairs = 0.0, triples = 0.0;
    const auto& z = e.recording.gyro_dps;
    for (const auto& span : e.conditions().spans(Part::train))
      for (std::size_t i = span.first + 2; i < span.last; ++i) {
        count += 1.0;
        if (z[i] != z[i - 1]) continue;
        pairs += 1.0;
        if (z[i] == z[i - 2]) triples += 1.0;
      }
    const double run = pairs > 0.0 ? 1.0 / std::max(0.02, 1.0 - triples / pairs) : 1.0;
    return with_noise_of(e, effects::StaleSamples{std::clamp(pairs / run / count, 1e-6, 1.0), run});
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::StaleSamples& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
