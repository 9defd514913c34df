#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/outliers.hpp>

namespace gyrostat::gap {

/// Steps of two widths.
template <>
struct Diagnosed<effects::Outliers> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::Outliers::probability,
                                                 &effects::Outliers::std_dps};

  /// A step is wider where one of its two samples was hit: two normal components, their widths
  /// and shares by maximum likelihood (expectation-maximisation; Dempster, Laird and Rubin, J.
  /// R. Stat. Soc. B 39, 1977).
  static std::vector<Start> starts(const Evidence& e) {
    const auto steps = train_steps(e);
    std::vector<double> sizes(steps.size());
    std::transform(steps.begin(), steps.end(), sizes.begin(), [](double d) { return std::abs(d); });
    const double deviation = quantile(sizes, 0.5) / normal_quartile;
    double narrow = deviation * deviation, wide = 25.0 * narrow, share = 0.005;
    for (int pass = 0; pass < 60; ++pass) {
      const double log_odds = std::log(share / (1.0 - share)) + 0.5 * std::log(narrow / wide);
      const double curve = 0.5 * (1.0 / narrow - 1.0 / wide);
      double weight = 0.0, of_wide = 0.0, of_narrow = 0.0;
      for (const double d : steps) {
        const double hit = 1.0 / (1.0 + std::exp(-(log_odds + curve * d * d)));
        weight += hit;
        of_wide += hit * d * d;
        of_narrow += (1.0 - hit) * d * d;
      }
      const double count = static_cast<double>(steps.size());
      share = std::clamp(weight / count, 1e-6, 0.75);
      narrow = of_narrow / std::max(1.0, count - weight);
      wide = std::max(of_wide / std::max(1e-9, weight), 2.0 * narrow);
    }
    return {{effects::Outliers{1.0 - std::sqrt(1.0 - share), std::sqrt(wide - narrow)},
             with_white(e, std::sqrt(0.5 * narrow))}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Outliers& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
