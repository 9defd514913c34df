#include <gyrostat/analysis/spectra/shrinkage.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr double normal_upper_quartile = 0.67448975019608171;

/// Standard deviation at `level` of unit white noise.
double level_std(const WaveletCoefficients& coefficients, std::size_t level) {
  return coefficients.transform == Transform::Decimated
             ? 1.0
             : std::pow(2.0, -0.5 * static_cast<double>(level));
}

}  // namespace

double thresholded(double coefficient, double threshold, ThresholdRule rule) {
  if (std::abs(coefficient) <= threshold) return 0.0;
  if (rule == ThresholdRule::Hard) return coefficient;
  return coefficient - std::copysign(threshold, coefficient);
}

double noise_std(const WaveletCoefficients& coefficients) {
  auto size = coefficients.detail.front();
  for (double& w : size) w = std::abs(w);
  const auto middle = size.begin() + std::ssize(size) / 2;
  std::nth_element(size.begin(), middle, size.end());
  double median = *middle;
  if (size.size() % 2 == 0) median = 0.5 * (median + *std::max_element(size.begin(), middle));
  return median / normal_upper_quartile / level_std(coefficients, 1);
}

double universal_threshold(const WaveletCoefficients& coefficients) {
  const std::size_t copies =
      coefficients.transform == Transform::Decimated ? 1 : coefficients.detail.size();
  return std::sqrt(2.0 * std::log(static_cast<double>(coefficients.samples * copies)));
}

void shrink(WaveletCoefficients& coefficients, double threshold, ThresholdRule rule) {
  for (std::size_t j = 0; j < coefficients.detail.size(); ++j)
    for (double& w : coefficients.detail[j])
      w = thresholded(w, threshold * level_std(coefficients, j + 1), rule);
}

ShrunkRate shrink_rate(std::span<const double> rate, const ShrinkageOptions& options) {
  const std::size_t n = rate.size();
  const std::size_t most = most_levels(options.wavelet, n);
  const std::size_t levels = options.levels == 0 ? most : options.levels;
  if (most == 0)
    throw InputError("rate", std::to_string(n) + " samples; at least " +
                                 std::to_string(scaling_filter(options.wavelet).size()) +
                                 " are needed");
  if (levels > most)
    throw InputError("levels", std::to_string(levels) + " is outside [1, " + std::to_string(most) +
                                   "] for " + std::to_string(n) + " samples");
  const bool decimated = options.transform == Transform::Decimated;
  const std::size_t block = decimated ? std::size_t{1} << levels : 1;
  const std::size_t half = (n + block - 1) / block * block;
  const auto there_and_back = reflected(reflected(rate, half), 2 * half);
  auto coefficients = decimated ? dwt(there_and_back, options.wavelet, levels)
                                : modwt(there_and_back, options.wavelet, levels);
  coefficients.samples = n;  // the mirror image holds nothing new
  ShrunkRate out{{}, noise_std(coefficients), 0.0, levels};
  out.threshold = out.noise_std * universal_threshold(coefficients);
  shrink(coefficients, out.threshold, options.rule);
  out.rate = inverse(coefficients);
  return out;
}

}  // namespace gyrostat
