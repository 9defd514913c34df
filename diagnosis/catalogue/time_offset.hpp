#pragma once

#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/time_offset.hpp>

namespace gyrostat::gap {

/// The rate, earlier or later.
template <>
struct Diagnosed<effects::TimeOffset> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::TimeOffset::offset_s,
                                                 &effects::TimeOffset::drift_ppm};

  /// Its sign and first size by the rate's derivative, then its size by the rate itself; and about
  /// that with a drift.
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
    const effects::TimeOffset constant{std::copysign(best_s, first_s)};
    const double step_s = 0.02 * interval_s;
    const double step_ppm =
        1e6 * step_s / (interval_s * static_cast<double>(e.conditions().size()));
    auto moved = signatures(e, Trace::rate,
                            {constant, effects::TimeOffset{constant.offset_s + step_s},
                             effects::TimeOffset{constant.offset_s, step_ppm}});
    for (const Eigen::Index c : {1, 2}) moved.col(c) -= moved.col(0);
    const auto by = match(moved.rightCols(2), seen - moved.col(0)).amplitudes;
    return {constant, effects::TimeOffset{constant.offset_s + by[0] * step_s, by[1] * step_ppm}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::TimeOffset& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
