#pragma once

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>
#include <gyrostat/diagnosis/starts/turning.hpp>
#include <gyrostat/generators/effects/misalignment.hpp>

namespace gyrostat::gap {

/// Shares of the rates about the two other axes.
template <>
struct Diagnosed<effects::Misalignment> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::Misalignment::share_1,
                                                 &effects::Misalignment::share_2};

  static std::vector<effects::Misalignment> starts(const Evidence& e) {
    const auto columns = signatures(
        e, Trace::rate, {effects::Misalignment{1.0, 0.0}, effects::Misalignment{0.0, 1.0}});
    const auto found = match(columns, trace_of(e, Trace::rate)).amplitudes;
    return {effects::Misalignment{found[0], found[1]}};
  }

  static std::string why_not_assessable(const Conditions& c) {
    constexpr double least_change_dps = 5.0;
    const auto &first = c.series().cross_rate_1_dps, &second = c.series().cross_rate_2_dps;
    if (first.empty() || second.empty())
      return "there are no cross_rate_1_dps and cross_rate_2_dps columns; add them, or the columns "
             "of all three gyros and choose one with --axis";
    const double span = std::max(inner_extent(quarter_second_means(c.series(), first)),
                                 inner_extent(quarter_second_means(c.series(), second)));
    if (span >= least_change_dps) return {};
    return fmt::format(
        "the sensor turns about the other axes by {:.2g} dps; at least {:g} dps are needed: turn "
        "the sensor about them, too",
        span, least_change_dps);
  }

  static bool is_what_it_is_called(const effects::Misalignment& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
