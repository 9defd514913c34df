#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/starts/start.hpp>

namespace gyrostat::gap {

using namespace effects;

namespace {

/// Autocovariance at lags 0, 1 and 2 of unit white noise through equal poles.
std::array<double, 3> through_poles(double pole, int poles) {
  std::vector<double> response(static_cast<std::size_t>(8.0 * poles / (1.0 - pole)) + 8, 0.0);
  response[0] = 1.0;
  for (int k = 0; k < poles; ++k) {
    double state = 0.0;
    for (double& h : response) h = state = pole * state + (1.0 - pole) * h;
  }
  std::array<double, 3> covariance{};
  for (std::size_t lag = 0; lag < 3; ++lag)
    for (std::size_t i = lag; i < response.size(); ++i)
      covariance[lag] += response[i] * response[i - lag];
  return covariance;
}

}  // namespace

std::vector<Start> start(Quantization, const Evidence& e) {
  std::vector<double> sorted;
  for (const auto& span : e.simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first; i < span.last && sorted.size() < 50000; ++i)
      sorted.push_back(e.recording.gyro_dps[i]);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> gaps;
  const double least = std::max(1.5 * e.simulator.resolution_dps(), 1e-12);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > least) gaps.push_back(sorted[i] - sorted[i - 1]);
  const double lsb =
      gaps.size() > 2 && gaps.size() < sorted.size() / 5 ? quantile(gaps, 0.2) : e.white_std_dps;
  const double rest = e.white_std_dps * e.white_std_dps - lsb * lsb / 12.0;
  return {{Quantization{lsb}, with_white(e, std::sqrt(std::max(rest, 0.01 * lsb * lsb)))}};
}

/// A step is wider where one of its two samples was hit: two normal components, their widths and
/// shares by maximum likelihood (expectation-maximisation; Dempster, Laird and Rubin, J. R. Stat.
/// Soc. B 39, 1977).
std::vector<Start> start(Outliers, const Evidence& e) {
  const auto steps = train_steps(e);
  std::vector<double> sizes(steps.size());
  std::transform(steps.begin(), steps.end(), sizes.begin(), [](double d) { return std::abs(d); });
  const double deviation = quantile(sizes, 0.5) / 0.6744897501960817;
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
  return {{Outliers{1.0 - std::sqrt(1.0 - share), std::sqrt(wide - narrow)},
           with_white(e, std::sqrt(0.5 * narrow))}};
}

/// From the variance and the first autocorrelation of the steps from sample to sample.
std::vector<Start> start(NoiseBandwidth, const Evidence& e) {
  const auto steps = train_steps(e);
  double square = 0.0, lagged = 0.0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    square += steps[i] * steps[i];
    lagged += steps[i] * steps[i - 1];
  }
  const double rate_hz = e.simulator.conditions().rate_hz();
  std::vector<Start> found;
  for (const int poles : {1, 2, 4}) {
    double low = 0.002, high = 0.99;
    for (int k = 0; k < 30; ++k) {
      const double pole = 0.5 * (low + high);
      const auto r = through_poles(pole, poles);
      ((2.0 * r[1] - r[0] - r[2]) / (2.0 * (r[0] - r[1])) < lagged / square ? low : high) = pole;
    }
    const auto r = through_poles(low, poles);
    found.push_back(
        {NoiseBandwidth{-std::log(low) * rate_hz / (2.0 * std::numbers::pi), 1.0 * poles},
         with_white(
             e, std::sqrt(square / static_cast<double>(steps.size()) / (2.0 * (r[0] - r[1]))))});
  }
  return found;
}

std::vector<Start> start(NoiseTemperature, const Evidence& e) {
  const auto& T = e.simulator.conditions().series().temperature_C;
  double sum = 0.0, mean_T = 0.0, count = 0.0, tt = 0.0, tv = 0.0;
  for (int pass = 0; pass < 2; ++pass)
    for (const auto& span : e.simulator.conditions().spans(Part::train))
      for (std::size_t i = span.first + 1; i < span.last; ++i) {
        const double v =
            0.5 * std::pow(e.scene.rate_error_dps[i] - e.scene.rate_error_dps[i - 1], 2);
        if (pass == 0) {
          sum += v;
          mean_T += T[i];
          count += 1.0;
        } else {
          const double d = T[i] - mean_T / count;
          tt += d * d;
          tv += d * (v - sum / count);
        }
      }
  return {{NoiseTemperature{tt > 0.0 ? 0.5 * tv / tt / (sum / count) : 0.0, mean_T / count},
           with_white(e, std::sqrt(sum / count))}};
}

std::vector<Start> start(StaleSamples, const Evidence& e) {
  double count = 0.0, pairs = 0.0, triples = 0.0;
  const auto& z = e.recording.gyro_dps;
  for (const auto& span : e.simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first + 2; i < span.last; ++i) {
      count += 1.0;
      if (z[i] != z[i - 1]) continue;
      pairs += 1.0;
      if (z[i] == z[i - 2]) triples += 1.0;
    }
  const double run = pairs > 0.0 ? 1.0 / std::max(0.02, 1.0 - triples / pairs) : 1.0;
  return with_noise_of(e, StaleSamples{std::clamp(pairs / run / count, 1e-6, 1.0), run});
}

}  // namespace gyrostat::gap
