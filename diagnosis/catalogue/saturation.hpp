#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/saturation.hpp>

namespace gyrostat::gap {

/// Rates beyond a limit are cut; limits above the fastest rate cut nothing. A limit of the output
/// is read off its values, so that what the likelihood finds is one of the sensing element, at once
/// or bent into, on both sides, alike or not, or on one.
template <>
struct Diagnosed<effects::Saturation> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {
      &effects::Saturation::limit_dps, &effects::Saturation::knee, &effects::Saturation::below_dps};

  static std::vector<effects::Saturation> starts(const Evidence& e) {
    std::vector<effects::Saturation> all;
    for (const double knee : {0.0, 0.05, 0.5})
      all.push_back(shaped(e, Trace::rate, effects::Saturation{.of_element = 1.0, .knee = knee},
                           &effects::Saturation::limit_dps, 0.05 * fastest_dps(e.conditions()),
                           1.02 * fastest_dps(e.conditions())));
    all.push_back({.limit_dps = mean_of_fastest_dps(e), .of_element = 1.0});
    // What is clipped with its bias has, beside the bias, two limits.
    for (const std::size_t alike : {std::size_t{0}, all.size() - 1}) {
      all.push_back(all[alike]);
      all.back().below_dps = all.back().limit_dps;
    }
    // On one side alone.
    const double fastest = fastest_dps(e.conditions()), never = 2.0 * fastest;
    using Limit = effects::Saturation;
    all.push_back(shaped(e, Trace::rate, Limit{.limit_dps = never, .of_element = 1.0},
                         &Limit::below_dps, 0.05 * fastest, 1.02 * fastest));
    all.push_back(shaped(e, Trace::rate, Limit{.of_element = 1.0, .below_dps = never},
                         &Limit::limit_dps, 0.05 * fastest, 1.02 * fastest));
    if (e.is_filtered())
      for (std::size_t k = 0, behind = all.size(); k < behind; ++k)
        all.push_back(across_a_filter(all[k]));
    return all;
  }

  /// With one limit, or with two that may differ, and on the other side of a filter.
  static std::vector<effects::Saturation> told_otherwise(const effects::Saturation& effect,
                                                         const Conditions& /*c*/) {
    auto other_limits = effect;
    other_limits.below_dps = effect.below_dps > 0.0 ? 0.0 : effect.limit_dps;
    return {other_limits, across_a_filter(effect), across_a_filter(other_limits)};
  }

  /// Before a filter of the rate, and not behind it, or the other way about.
  static effects::Saturation across_a_filter(effects::Saturation effect) {
    if (effect.of_element > 0.5) effect.of_element = 3.0 - effect.of_element;
    return effect;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::Saturation& /*effect*/, const Conditions& /*c*/) {
    return true;
  }

 private:
  /// What is sensed of the fastest thousandth of the motion: the limit, where that cuts no more
  /// than the ends of it.
  static double mean_of_fastest_dps(const Evidence& e) {
    const auto& rate = e.conditions().series().rate_ref_dps;
    const auto& error = e.scene.rate_error_dps;
    std::vector<std::pair<double, double>> of_rates;  // their size, and how far off they are sensed
    for (const auto& span : e.conditions().spans(Part::train))
      for (std::size_t i = span.first; i < span.last; ++i)
        if (!is_missing(rate[i]) && !is_missing(error[i]))
          of_rates.emplace_back(std::abs(rate[i]), std::copysign(1.0, rate[i]) * error[i]);
    constexpr std::size_t fewest = 10;
    const std::size_t count = std::max(fewest, of_rates.size() / 1000);
    if (of_rates.size() < count) return fastest_dps(e.conditions());
    std::partial_sort(of_rates.begin(), of_rates.begin() + static_cast<std::ptrdiff_t>(count),
                      of_rates.end(), std::greater<>());
    of_rates.resize(count);
    double sensed = 0.0;
    for (const auto& [size, off] : of_rates) sensed += size + off;
    return sensed / static_cast<double>(count);
  }
};

}  // namespace gyrostat::gap
