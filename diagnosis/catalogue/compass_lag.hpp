#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/compass_lag.hpp>

namespace gyrostat::gap {

/// The heading follows turns late, through a delay, one pole or several, each a start of its own.
/// What a recorder delays beside the poles, if by part of a sample, is told from them by turns that
/// begin at once.
template <>
struct Diagnosed<effects::CompassLag> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::CompassLag::time_constant_s,
                                                 &effects::CompassLag::delay_s};

  static std::vector<effects::CompassLag> starts(const Evidence& e) {
    const double least_s = 0.05 * e.conditions().interval_s();
    constexpr double most_s = 30.0;
    std::vector<effects::CompassLag> all;
    for (const double poles : {1.0, 2.0, 4.0})
      all.push_back(shaped(e, Trace::heading, effects::CompassLag{.poles = poles},
                           &effects::CompassLag::time_constant_s, least_s, most_s));
    all.push_back(shaped(e, Trace::heading, effects::CompassLag{.of_field = 1.0},
                         &effects::CompassLag::time_constant_s, least_s, most_s));
    all.push_back(shaped(e, Trace::heading, effects::CompassLag{.time_constant_s = 0.0},
                         &effects::CompassLag::delay_s, least_s, most_s));
    return all;
  }

  /// The other ways to be as late, without what a recorder adds.
  static std::vector<effects::CompassLag> told_otherwise(const effects::CompassLag& effect,
                                                         const Conditions& /*conditions*/) {
    const double late_s = effect.time_constant_s + effect.delay_s;
    const auto poles_of = [](const effects::CompassLag& lag) {
      return lag.time_constant_s > 0.0 ? lag.poles : 0.0;
    };
    std::vector<effects::CompassLag> all;
    for (const effects::CompassLag& form :
         {effects::CompassLag{.time_constant_s = late_s, .poles = 1.0},
          effects::CompassLag{.time_constant_s = late_s, .poles = 2.0},
          effects::CompassLag{.time_constant_s = late_s, .poles = 4.0},
          effects::CompassLag{.time_constant_s = late_s, .of_field = 1.0},
          effects::CompassLag{.time_constant_s = 0.0, .delay_s = late_s}}) {
      if (poles_of(form) == poles_of(effect) && form.of_field == effect.of_field) continue;
      all.push_back(form);
      all.back().turns_alone = effect.turns_alone;
    }
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) {
    if (auto why = needs::heading(c); !why.empty()) return why;
    return needs::motion(c);
  }

  /// A lag of less than a twentieth of a sample is none.
  static bool is_what_it_is_called(const effects::CompassLag& effect, const Conditions& c) {
    return effect.time_constant_s + effect.delay_s > 0.05 * c.interval_s();
  }
};

}  // namespace gyrostat::gap
