#pragma once

#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/scale_factor.hpp>

namespace gyrostat::gap {

/// A share of the rate, alike at all rates or with its square.
template <>
struct Diagnosed<effects::ScaleFactor> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::ScaleFactor::error,
                                                 &effects::ScaleFactor::cubic_per_dps2};

  static std::vector<effects::ScaleFactor> starts(const Evidence& e) {
    using Scale = effects::ScaleFactor;
    const double fastest = fastest_dps(e.conditions()), of_fastest = 1.0 / (fastest * fastest);
    const auto both = match(signatures(e, Trace::rate, {Scale{1.0}, Scale{0.0, of_fastest}}),
                            trace_of(e, Trace::rate))
                          .amplitudes;
    return {scaled(e, Trace::rate, Scale{}, [](auto& p, double a) { p.error = a; }),
            {both[0], both[1] * of_fastest}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  /// What bends by more than a tenth of the fastest rate is no scale: between the few rates of a
  /// table it is any function.
  static bool is_what_it_is_called(const effects::ScaleFactor& effect, const Conditions& c) {
    constexpr double most_bent = 0.1;
    return std::abs(effect.cubic_per_dps2) * fastest_dps(c) * fastest_dps(c) < most_bent;
  }
};

}  // namespace gyrostat::gap
