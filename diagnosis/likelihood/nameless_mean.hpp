#pragma once

#include <optional>

#include <gyrostat/diagnosis/likelihood/nameless.hpp>

namespace gyrostat::gap {

/// What a set leaves of the mean over temperature, as a linear spline of three, five or nine knots:
/// as many as the recording is likeliest with, coefficients integrated out. None where that gains
/// no more than chance would.
std::optional<Nameless> mean_over_temperature(const Conditions& conditions, const SetFitter& fitter,
                                              const Scenario& set);
/// The same over the true rate.
std::optional<Nameless> mean_over_rate(const Conditions& conditions, const SetFitter& fitter,
                                       const Scenario& set);

/// Whether an effect is such a spline, the same in every replica.
bool is_mean_without_name(const Effect& effect);

}  // namespace gyrostat::gap
