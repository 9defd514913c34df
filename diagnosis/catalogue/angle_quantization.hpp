#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/angle_quantization.hpp>

namespace gyrostat::gap {

/// Samples that differ from their neighbours more than white noise does.
template <>
struct Diagnosed<effects::AngleQuantization> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::AngleQuantization::coefficient_deg};

  /// With q = (Q / interval)^2 beside white noise of variance w, the steps from sample to sample
  /// have the variance 2 w + 6 q and the lag-1 autocovariance -w - 4 q.
  static std::vector<Start> starts(const Evidence& e) {
    const auto steps = train_steps(e);
    double square = 0.0, lagged = 0.0;
    for (std::size_t i = 1; i < steps.size(); ++i) {
      square += steps[i] * steps[i];
      lagged += steps[i] * steps[i - 1];
    }
    const auto count = static_cast<double>(std::max<std::size_t>(2, steps.size()) - 1);
    const double q = -(lagged + 0.5 * square) / count;
    if (!(q > 0.0)) return {};
    const double white = std::max(0.5 * square / count - 3.0 * q, 0.01 * q);
    return {{effects::AngleQuantization{std::sqrt(q) * e.conditions().interval_s()},
             with_white(e, std::sqrt(white))}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::AngleQuantization& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
