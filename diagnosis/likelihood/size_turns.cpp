#include <gyrostat/diagnosis/likelihood/size_turns.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/starts/quantile.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>

namespace gyrostat::gap {

double turns_of(const std::vector<std::size_t>& samples, const std::vector<double>& squares,
                double narrow) {
  constexpr double obvious = 40.0, fastest = 0.3, slowest = 1.0 / 512.0, largest = 9.0;
  std::vector<double> sizes(std::bit_ceil(samples.back() + 1), 0.0);
  double mean = 0.0;
  for (const double s : squares)
    mean += std::min(s / narrow, largest) / static_cast<double>(squares.size());
  for (std::size_t k = 0; k < samples.size(); ++k)
    sizes[samples[k]] = std::min(squares[k] / narrow, largest) - mean;
  const auto length = static_cast<double>(sizes.size());
  const auto first = static_cast<std::size_t>(slowest * length);
  const auto power = powers_of(sizes, first, static_cast<std::size_t>(fastest * length));
  if (power.empty()) return 0.0;
  const auto peak = std::max_element(power.begin(), power.end());
  if (*peak < obvious * quantile(power, 0.5) / std::numbers::ln2) return 0.0;
  return static_cast<double>(first + static_cast<std::size_t>(peak - power.begin())) / length;
}

}  // namespace gyrostat::gap
