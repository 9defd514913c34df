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
    const auto left_by = [&](const effects::TimeOffset& trial) {
      return (seen - signatures(e, Trace::rate, {trial})).squaredNorm();
    };
    const auto shifted = [&](double straight) {
      effects::TimeOffset shift{.straight = straight};
      shift.offset_s = std::copysign(best_of(0.2 * size_s, 20.0 * size_s,
                                             [&](double offset_s) {
                                               shift.offset_s = std::copysign(offset_s, first_s);
                                               return left_by(shift);
                                             }),
                                     first_s);
      return shift;
    };
    const auto curved = shifted(0.0), straight = shifted(1.0);
    const auto constant = left_by(straight) < left_by(curved) ? straight : curved;
    const double step_s = 0.02 * interval_s;
    const double step_ppm =
        1e6 * step_s / (interval_s * static_cast<double>(e.conditions().size()));
    auto later = constant, drifting = constant;
    later.offset_s += step_s;
    drifting.drift_ppm = step_ppm;
    auto moved = signatures(e, Trace::rate, {constant, later, drifting});
    for (const Eigen::Index c : {1, 2}) moved.col(c) -= moved.col(0);
    const auto by = match(moved.rightCols(2), seen - moved.col(0)).amplitudes;
    drifting.offset_s += by[0] * step_s;
    drifting.drift_ppm *= by[1];
    return {curved, straight, drifting};
  }

  /// The rate between its samples as the other form has it.
  static std::vector<effects::TimeOffset> told_otherwise(const effects::TimeOffset& effect,
                                                         const Conditions& /*c*/) {
    auto other = effect;
    other.straight = effect.straight < 0.5 ? 1.0 : 0.0;
    return {other};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  /// A twentieth of a neighbour and less is any errors of the reference.
  static bool is_what_it_is_called(const effects::TimeOffset& effect, const Conditions& c) {
    constexpr double least = 0.05;
    return effect.straight < 0.5 || std::abs(effect.offset_s) > least * c.interval_s();
  }
};

}  // namespace gyrostat::gap
