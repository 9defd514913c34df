#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The sensor averages faster white noise over `length` samples, once or twice in a row (a moving
/// average, and a Bartlett window), as many do before they are read out. Seen at the samples, the
/// autocovariance at lag k is in proportion to b(k / length): of one average the hat
/// b(x) = 1 - x up to 1, of two the cubic B-spline b(x) = 1 - 3 x^2 / 2 + 3 x^3 / 4 up to 1 and
/// (2 - x)^3 / 4 up to 2 (Schoenberg, Quarterly of Applied Mathematics 4, 1946); beyond
/// stages x length samples it is 0, and with stages x length <= 1 the noise stays white. What
/// averages the output's own samples (`of_samples`), the last of them in part, has the
/// autocovariance of its taps: once over whole samples it is the same, twice over two they are
/// 1, 2, 1. What is read in straight lines between the samples of another clock, which runs ahead
/// by `slip` of a sample at each, or behind, averages two of them in shares that go round: the
/// variance comes and goes with them, and on average over all places neighbours are alike by about
/// a quarter. The noise keeps its density at rest, as behind noise_bandwidth.
///
/// What is of faster samples is made of the white noise by the innovations algorithm (Brockwell &
/// Davis, Time Series: Theory and Methods, 1991, 5.3.9), so that it is stationary from the first
/// sample; of the output's own, the first average the last. Samples count, not the intervals
/// between them.
struct NoiseAveraging {
  double length = 1.3;
  double stages = 1.0;
  double of_samples = 0.0;
  double after_dps = 0.0;
  double slip = 0.0;

  static constexpr std::string_view title = "the white noise is a moving average";
  static constexpr Stage stage = Stage::noise;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};

  static constexpr auto fields() {
    using P = NoiseAveraging;
    return std::array{
        Field{"length", &P::length, "samples", Range{.from = 0, .to = 16},
              "over how many sampling intervals it averages"},
        Field{"stages", &P::stages, "1", Range{.from = 1, .to = 2, .whole = true},
              "how many averages in a row"},
        Field{"of_samples", &P::of_samples, "1", ranges::flag,
              "1: of the output's own samples; 0: of faster ones"},
        Field{"after_dps", &P::after_dps, "dps", ranges::non_negative,
              "standard deviation of the white noise after the averages"},
        Field{"slip", &P::slip, "samples", Range{.from = -0.3, .to = 0.3},
              "by which the clock of what is read in straight lines runs ahead at each sample; 0: "
              "nothing is, and the length counts"},
    };
  }

  static constexpr NoiseAveraging absent() { return {.length = 0.0}; }

  /// Of unit white noise, from lag 0 to the last at which it is not 0. Lag 0 and twice the others
  /// add up to 1.
  std::vector<double> autocovariance() const {
    if (slip != 0.0) {
      const auto between = between_samples();
      std::vector<double> b;
      for (const double covariance : between.covariance) b.push_back(covariance / between.at_rest);
      return b;
    }
    if (of_samples > 0.5) {
      const auto taps = taps_of_samples();
      std::vector<double> b(taps.size(), 0.0);
      for (std::size_t k = 0; k < taps.size(); ++k)
        for (std::size_t i = k; i < taps.size(); ++i) b[k] += taps[i] * taps[i - k];
      return b;
    }
    const bool twice = stages > 1.5;
    std::vector<double> b = {1.0};
    double density = 1.0;
    for (double k = 1.0; k < (twice ? 2.0 : 1.0) * length; ++k) {
      const double x = k / length;
      b.push_back(!twice    ? 1.0 - x
                  : x < 1.0 ? 1.0 - 0.75 * x * x * (2.0 - x)
                            : 0.25 * std::pow(2.0 - x, 3));
      density += 2.0 * b.back();
    }
    for (double& value : b) value /= density;
    return b;
  }

  void apply(Series& series, const Noise& noise) const {
    if (slip != 0.0)
      pass_between(series, noise.stream("noise_averaging/place").uniform(0));
    else if (of_samples > 0.5)
      pass_own(series);
    else
      pass_faster(series);
    if (after_dps == 0.0) return;
    const auto after = noise.stream("noise_averaging/after");
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += after_dps * after.normal(i);
  }

 private:
  /// Whose sum is 1.
  std::vector<double> taps_of_samples() const {
    std::vector<double> taps(static_cast<std::size_t>(length), 1.0);
    if (const double part = length - std::floor(length); part > 0.0 || taps.empty())
      taps.push_back(taps.empty() ? 1.0 : part);
    if (stages > 1.5) {
      std::vector<double> again(2 * taps.size() - 1, 0.0);
      for (std::size_t i = 0; i < taps.size(); ++i)
        for (std::size_t j = 0; j < taps.size(); ++j) again[i + j] += taps[i] * taps[j];
      taps = std::move(again);
    }
    const double sum = std::accumulate(taps.begin(), taps.end(), 0.0);
    for (double& tap : taps) tap /= sum;
    return taps;
  }

  /// What was before the first samples is as likely as what the last are, and a recursion without
  /// it does not reach zeros on the unit circle.
  void pass_own(Series& series) const {
    const auto taps = taps_of_samples();
    const std::size_t n = samples_with(series, needs);
    if (n < taps.size()) return;
    std::vector<double> white(n);
    for (std::size_t i = 0; i < n; ++i) white[i] = error_beside_drift(series, i);
    for (std::size_t i = 0; i < n; ++i) {
      double averaged = 0.0;
      for (std::size_t k = 0; k < taps.size(); ++k)
        averaged += taps[k] * white[i >= k ? i - k : i + n - k];
      series.gyro_dps[i] += averaged - white[i];
    }
  }

  struct Between {
    std::array<double, 3> covariance;
    double at_rest;  ///< density
  };
  /// Of unit white noise, the mean over all places; a clock that is behind may be asked twice
  /// between two of its samples.
  Between between_samples() const {
    const double behind = std::max(-slip, 0.0), ahead = std::max(slip, 0.0);
    Between b{{2.0 / 3.0, std::pow(1.0 - ahead, 3) / 6.0, std::pow(2.0 * behind, 3) / 6.0}, 0.0};
    if (behind > 0.0)
      b.covariance[1] = 0.5 * (1.0 + behind) * (1.0 - behind * behind) -
                        (1.0 - std::pow(behind, 3)) / 3.0 + behind * behind -
                        std::pow(behind, 3) / 3.0;
    b.at_rest = b.covariance[0] + 2.0 * (b.covariance[1] + b.covariance[2]);
    return b;
  }

  /// Its samples are the white noise, which begins anew where it ends.
  void pass_between(Series& series, double place) const {
    const std::size_t n = samples_with(series, needs);
    std::vector<double> white(n);
    for (std::size_t i = 0; i < n; ++i) white[i] = error_beside_drift(series, i);
    const double scale = 1.0 / std::sqrt(between_samples().at_rest);
    for (std::size_t i = 0; i < n; ++i) {
      const double at = place + (1.0 + slip) * static_cast<double>(i), before = std::floor(at);
      const auto k = static_cast<std::size_t>(before) % n;
      const double now = white[k] + (at - before) * (white[(k + 1) % n] - white[k]);
      series.gyro_dps[i] += scale * now - white[i];
    }
  }

  void pass_faster(Series& series) const {
    const auto covariance = autocovariance();
    const std::size_t taps = covariance.size();
    // Row i of the Cholesky factor of the samples' covariance, element j at j modulo taps; the last
    // rows are at i modulo taps, and so is the white noise.
    std::vector<std::vector<double>> rows(taps, std::vector<double>(taps));
    std::vector<double> white(taps);
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      auto& row = rows[i % taps];
      white[i % taps] = error_beside_drift(series, i);
      const std::size_t first = i < taps ? 0 : i - taps + 1;
      double averaged = 0.0;
      for (std::size_t j = first; j <= i; ++j) {
        const auto& other = rows[j % taps];
        double rest = covariance[i - j];
        for (std::size_t k = first; k < j; ++k) rest -= row[k % taps] * other[k % taps];
        row[j % taps] = j == i ? std::sqrt(std::max(rest, 0.0)) : rest / other[j % taps];
        averaged += row[j % taps] * white[j % taps];
      }
      series.gyro_dps[i] += averaged - white[i % taps];
    }
  }
};

}  // namespace gyrostat::effects
