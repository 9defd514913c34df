#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/fast_part.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// All fast errors of the rate together pass the filter of least phase whose gain at an angle w,
/// radians a sample, is exp(level + sum of cepstrum_k cos(k w)) (an exponential model of the
/// spectrum: Bloomfield, Biometrika 60, 1973; its response by recursion: Oppenheim and Schafer,
/// "Discrete-Time Signal Processing", 3rd ed., 13.6). It takes away as well as it adds, whatever
/// the errors are called. It is not in the catalogue, and is never named as a cause.
struct EmpiricalFilter {
  double level = 0.0;
  double cepstrum_1 = 0.3, cepstrum_2 = 0.0, cepstrum_3 = 0.0, cepstrum_4 = 0.0, cepstrum_5 = 0.0,
         cepstrum_6 = 0.0, cepstrum_7 = 0.0, cepstrum_8 = 0.0, cepstrum_9 = 0.0, cepstrum_10 = 0.0,
         cepstrum_11 = 0.0, cepstrum_12 = 0.0, cepstrum_13 = 0.0, cepstrum_14 = 0.0,
         cepstrum_15 = 0.0, cepstrum_16 = 0.0, cepstrum_17 = 0.0, cepstrum_18 = 0.0,
         cepstrum_19 = 0.0, cepstrum_20 = 0.0, cepstrum_21 = 0.0, cepstrum_22 = 0.0,
         cepstrum_23 = 0.0, cepstrum_24 = 0.0;

  static constexpr std::string_view title = "fast errors have a spectrum without a name";
  static constexpr Stage stage = Stage::conversion;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};

  static constexpr auto fields() {
    using P = EmpiricalFilter;
    constexpr auto& of_order = "coefficient of a cosine in the logarithm of the gain";
    return std::array{
        Field{"level", &P::level, "1", ranges::any, "mean logarithm of the gain"},
        Field{"cepstrum_1", &P::cepstrum_1, "1", ranges::any, of_order},
        Field{"cepstrum_2", &P::cepstrum_2, "1", ranges::any, of_order},
        Field{"cepstrum_3", &P::cepstrum_3, "1", ranges::any, of_order},
        Field{"cepstrum_4", &P::cepstrum_4, "1", ranges::any, of_order},
        Field{"cepstrum_5", &P::cepstrum_5, "1", ranges::any, of_order},
        Field{"cepstrum_6", &P::cepstrum_6, "1", ranges::any, of_order},
        Field{"cepstrum_7", &P::cepstrum_7, "1", ranges::any, of_order},
        Field{"cepstrum_8", &P::cepstrum_8, "1", ranges::any, of_order},
        Field{"cepstrum_9", &P::cepstrum_9, "1", ranges::any, of_order},
        Field{"cepstrum_10", &P::cepstrum_10, "1", ranges::any, of_order},
        Field{"cepstrum_11", &P::cepstrum_11, "1", ranges::any, of_order},
        Field{"cepstrum_12", &P::cepstrum_12, "1", ranges::any, of_order},
        Field{"cepstrum_13", &P::cepstrum_13, "1", ranges::any, of_order},
        Field{"cepstrum_14", &P::cepstrum_14, "1", ranges::any, of_order},
        Field{"cepstrum_15", &P::cepstrum_15, "1", ranges::any, of_order},
        Field{"cepstrum_16", &P::cepstrum_16, "1", ranges::any, of_order},
        Field{"cepstrum_17", &P::cepstrum_17, "1", ranges::any, of_order},
        Field{"cepstrum_18", &P::cepstrum_18, "1", ranges::any, of_order},
        Field{"cepstrum_19", &P::cepstrum_19, "1", ranges::any, of_order},
        Field{"cepstrum_20", &P::cepstrum_20, "1", ranges::any, of_order},
        Field{"cepstrum_21", &P::cepstrum_21, "1", ranges::any, of_order},
        Field{"cepstrum_22", &P::cepstrum_22, "1", ranges::any, of_order},
        Field{"cepstrum_23", &P::cepstrum_23, "1", ranges::any, of_order},
        Field{"cepstrum_24", &P::cepstrum_24, "1", ranges::any, of_order},
    };
  }

  static constexpr std::size_t order = 24;
  static constexpr EmpiricalFilter absent() { return {.cepstrum_1 = 0.0}; }

  /// The filter's response to a unit impulse, as far as it matters.
  std::vector<double> response() const {
    const std::array<double, order> cepstrum{
        cepstrum_1,  cepstrum_2,  cepstrum_3,  cepstrum_4,  cepstrum_5,  cepstrum_6,
        cepstrum_7,  cepstrum_8,  cepstrum_9,  cepstrum_10, cepstrum_11, cepstrum_12,
        cepstrum_13, cepstrum_14, cepstrum_15, cepstrum_16, cepstrum_17, cepstrum_18,
        cepstrum_19, cepstrum_20, cepstrum_21, cepstrum_22, cepstrum_23, cepstrum_24};
    constexpr std::size_t longest = 256;
    constexpr double least = 1e-6;
    std::vector<double> h{std::exp(level)};
    std::size_t matters = 1;
    for (std::size_t n = 1; n < longest; ++n) {
      double sum = 0.0;
      for (std::size_t k = 1; k <= std::min(n, order); ++k)
        sum += static_cast<double>(k) * cepstrum[k - 1] * h[n - k];
      h.push_back(sum / static_cast<double>(n));
      if (std::abs(h.back()) > least * h[0]) matters = n + 1;
    }
    h.resize(matters);
    return h;
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    const auto h = response();
    const std::size_t samples = samples_with(series, needs);
    std::vector<double> fast(samples);
    FastPart part;
    for (std::size_t i = 0; i < samples; ++i)
      fast[i] = part(series.t_s, i, error_beside_drift(series, i));
    for (std::size_t i = 0; i < samples; ++i) {
      double filtered = 0.0;
      for (std::size_t k = 0; k < std::min(h.size(), i + 1); ++k) filtered += h[k] * fast[i - k];
      series.gyro_dps[i] += filtered - fast[i];
    }
  }
};

}  // namespace gyrostat::effects
