#pragma once

#include <cmath>
#include <optional>

#include <gyrostat/diagnosis/likelihood/autoregression.hpp>
#include <gyrostat/diagnosis/likelihood/nameless.hpp>

namespace gyrostat::gap {

/// An order of an autoregression.
struct ChosenOrder {
  std::size_t order;
  double gain;  ///< nats against white noise of variance 1, less one a parameter
};

/// That of the least Akaike criterion, from so many independent values.
inline ChosenOrder order_of(const Autoregression& all, double values) {
  ChosenOrder best{0, -1e300};
  for (std::size_t p = 0; p < all.errors.size(); ++p) {
    const double gain =
        0.5 * values * (all.errors[0] - 1.0 - std::log(all.errors[p])) - static_cast<double>(p + 1);
    if (gain > best.gain) best = {p, gain};
  }
  return best;
}

/// What the white noise of a fitted set lacks of the recording's fast spectrum.
std::optional<Nameless> colour_of_the_noise(const Conditions& conditions, const SetFitter& fitter,
                                            const Scenario& set);
/// What the white compass noise of a set lacks of the heading's: a wander, and what colours the
/// rest.
std::optional<Nameless> colour_of_the_compass(const Simulator& simulator, const Series& recording,
                                              const Scenario& set);

}  // namespace gyrostat::gap
