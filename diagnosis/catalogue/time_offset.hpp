#pragma once

#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/remedies.hpp>
#include <gyrostat/generators/effects/time_offset.hpp>

namespace gyrostat::gap {

/// The rate, earlier or later.
template <>
struct Diagnosed<effects::TimeOffset> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::TimeOffset::offset_s};

  /// Its sign and first size by the rate's derivative, then its size by the rate itself.
  static std::vector<effects::TimeOffset> starts(const Evidence& e) {
    const auto seen = trace_of(e, Trace::rate);
    const double interval_s = e.conditions().interval_s();
    const double first_s =
        interval_s *
        match(signatures(e, Trace::rate, {effects::TimeOffset{interval_s}}), seen).amplitudes[0];
    const double size_s = std::max(std::abs(first_s), 1e-3 * interval_s);
    const double best_s = best_of(0.2 * size_s, 20.0 * size_s, [&](double offset_s) {
      const effects::TimeOffset trial{std::copysign(offset_s, first_s)};
      return (seen - signatures(e, Trace::rate, {trial})).squaredNorm();
    });
    return {effects::TimeOffset{std::copysign(best_s, first_s)}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::told_motion(c); }

  static bool is_what_it_is_called(const effects::TimeOffset& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
