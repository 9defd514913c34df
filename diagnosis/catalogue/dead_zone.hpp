#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/dead_zone.hpp>

namespace gyrostat::gap {

/// Small rates are lost, with or without their share of larger ones, at a threshold or about it.
template <>
struct Diagnosed<effects::DeadZone> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {
      &effects::DeadZone::half_width_dps, &effects::DeadZone::lost_beyond,
      &effects::DeadZone::dither, &effects::DeadZone::below_dps};

  static std::size_t chosen_parameters(const effects::DeadZone& effect) {
    return effect.dither != 0.0 ? 1 : 0;
  }

  static std::vector<effects::DeadZone> starts(const Evidence& e) {
    // That of a play adds up far below the noise, by the direction of the rate.
    const double narrowest_dps = std::min(0.001 * fastest_dps(e.conditions()),
                                          0.01 * e.baseline.random_error.measurement_noise_std_dps);
    const double widest_dps = most_of_motion * fastest_dps(e.conditions());
    using Zone = effects::DeadZone;
    std::vector<Zone> found;
    // Before a filter, what a zone loses is spread over the samples behind it.
    for (const double of_element : {0.0, 1.0}) {
      if (of_element != 0.0 && !e.is_filtered()) continue;
      for (const double dither : {0.0, 0.3})
        for (const double lost : {0.0, 1.0})
          found.push_back(shaped(
              e, Trace::rate, Zone{.lost_beyond = lost, .dither = dither, .of_element = of_element},
              &Zone::half_width_dps, narrowest_dps, widest_dps));
    }
    // One side after the other, where the zone is. A level that walks takes up what a zone begun
    // from elsewhere is off by: only beside the right ones does it see either edge.
    Evidence steady = e;
    steady.level_gain = 0.0;
    constexpr double near = 1.1;
    const auto left = left_by_each(e, Trace::rate, std::vector<Effect>(found.begin(), found.end()));
    const auto clearest = std::min_element(left.begin(), left.end()) - left.begin();
    constexpr std::ptrdiff_t shapes = 4;  // of a side
    const auto first = static_cast<std::size_t>(clearest / shapes * shapes);
    for (const std::size_t even : {first, first + 1}) {
      Zone zone = found[even];
      zone.below_dps = zone.half_width_dps;
      constexpr std::array sides = {&Zone::half_width_dps, &Zone::below_dps};
      for (int pass = 0; pass < 2; ++pass)
        for (const auto side : sides)
          zone = shaped(steady, Trace::rate, zone, side, narrowest_dps, widest_dps);
      for (const auto side : sides)
        zone = shaped(e, Trace::rate, zone, side, zone.*side / near, zone.*side * near);
      found.push_back(zone);
      if (e.is_filtered()) found.push_back(across_a_filter(zone));
    }
    return found;
  }

  static std::vector<effects::DeadZone> told_otherwise(const effects::DeadZone& effect,
                                                       const Conditions& /*c*/) {
    return {across_a_filter(effect)};
  }

  /// Before a filter of the rate, and not behind it, or the other way about.
  static effects::DeadZone across_a_filter(effects::DeadZone effect) {
    if (effect.of_output < 0.5) effect.of_element = 1.0 - effect.of_element;
    return effect;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::DeadZone& effect, const Conditions& c) {
    return std::max(effect.half_width_dps, effect.below_dps) <= most_of_motion * fastest_dps(c);
  }

 private:
  /// Else the zone is not about rest.
  static constexpr double most_of_motion = 0.5;
};

}  // namespace gyrostat::gap
