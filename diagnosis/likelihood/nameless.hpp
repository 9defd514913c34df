#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gyrostat/diagnosis/likelihood/set_fit.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// Nats by which a part gains beyond what its parameters win by chance.
inline constexpr double clear_gain = 10.0;

/// A part of what named effects leave, as it shows, without a cause.
struct Nameless {
  Effect effect;         ///< outside the catalogue, as empirical_noise
  std::string in_words;  ///< as "a coloured noise, mostly from 3 to 12 Hz"
  /// Where the walk stood in for it: what is left of the random error beside it.
  std::optional<Arima111<double>> beside{};
};

/// What a fitted set leaves of the mean over temperature and over the rate, as linear splines; what
/// its white noise lacks of the recording's fast spectrum, and what its white compass noise lacks
/// of the heading's, each as an autoregression of the train part. Its order is that of the least
/// Akaike criterion, which is what leaving out one by one would choose (Stone, Journal of the Royal
/// Statistical Society B 39, 1977), with the likelihood of Whittle; none where it gains no more
/// than chance would.
///
/// `fitted` is the set as `fitter` knows it, `set` the same with its drift, its compass and its
/// names.
std::vector<Nameless> nameless_parts(const Simulator& simulator, const Series& recording,
                                     const SetFitter& fitter, const Scenario& fitted,
                                     const Scenario& set);

/// Whether an effect stands outside of the catalogue, for what has no name.
bool is_nameless(const Effect& effect);

/// The set with them.
Scenario with_nameless(Scenario set, const std::vector<Nameless>& parts);

}  // namespace gyrostat::gap
