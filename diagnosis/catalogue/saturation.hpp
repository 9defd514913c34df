#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/saturation.hpp>

namespace gyrostat::gap {

/// Rates beyond a limit are cut; limits above the fastest rate cut nothing. A limit of the output
/// is read off its values, so that what the likelihood finds is one of the sensing element, at once
/// or bent into.
template <>
struct Diagnosed<effects::Saturation> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::Saturation::limit_dps,
                                                 &effects::Saturation::knee};

  static std::vector<effects::Saturation> starts(const Evidence& e) {
    std::vector<effects::Saturation> all;
    for (const double knee : {0.0, 0.05, 0.5})
      all.push_back(shaped(e, Trace::rate, effects::Saturation{.of_element = 1.0, .knee = knee},
                           &effects::Saturation::limit_dps, 0.05 * fastest_dps(e.conditions()),
                           1.02 * fastest_dps(e.conditions())));
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::Saturation& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
