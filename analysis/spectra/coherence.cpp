#include <gyrostat/analysis/spectra/coherence.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <vector>

#include <gyrostat/core/step.hpp>

namespace gyrostat {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

bool misses_any(std::span<const double> values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return is_missing(v); });
}

/// The windowed kernel of one frequency, e^(-i 2 pi cycles k) by Hann's window.
std::vector<std::complex<double>> kernel_of(double cycles, std::size_t length) {
  std::vector<std::complex<double>> kernel(length);
  for (std::size_t k = 0; k < length; ++k) {
    const auto at = static_cast<double>(k);
    const double window = 0.5 - 0.5 * std::cos(turn * at / static_cast<double>(length));
    kernel[k] = std::polar(window, -turn * cycles * at);
  }
  return kernel;
}

std::complex<double> transform(std::span<const double> values,
                               std::span<const std::complex<double>> kernel) {
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  std::complex<double> sum = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) sum += (values[k] - mean) * kernel[k];
  return sum;
}

}  // namespace

Coherence coherence(std::span<const double> x, std::span<const double> y, double cycles,
                    std::size_t length) {
  const auto kernel = kernel_of(cycles, length);
  Coherence found;
  double power_x = 0.0, power_y = 0.0;
  std::complex<double> cross = 0.0;
  for (std::size_t first = 0; first + length <= x.size(); first += length) {
    const auto of_x = x.subspan(first, length), of_y = y.subspan(first, length);
    if (misses_any(of_x) || misses_any(of_y)) continue;
    const auto at_x = transform(of_x, kernel), at_y = transform(of_y, kernel);
    power_x += std::norm(at_x);
    power_y += std::norm(at_y);
    cross += at_x * std::conj(at_y);
    ++found.segments;
  }
  if (power_x > 0.0 && power_y > 0.0) found.squared = std::norm(cross) / (power_x * power_y);
  return found;
}

double chance_of(const Coherence& coherence) {
  if (coherence.segments < 2) return 1.0;
  return std::pow(std::max(0.0, 1.0 - coherence.squared),
                  static_cast<double>(coherence.segments) - 1.0);
}

}  // namespace gyrostat
