#include <gyrostat/diagnosis/likelihood/blurred_grid.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_free_values = 1000;

struct Values {
  std::vector<double> dps;
  double noise_dps = 0.0;  ///< from sample to sample or about their mean, whichever is less
};

/// Those that are neither repeated nor at an end nor exactly zero: what a converter clips, holds or
/// leaves out is at one value, whose characteristic function does not fall.
Values free_values(const Conditions& conditions, const std::vector<double>& z) {
  const auto& reference = conditions.series().rate_ref_dps;
  const auto known = [&](std::size_t i) { return reference.empty() ? 0.0 : reference[i]; };
  double low = 1e300, high = -1e300;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(z[i])) low = std::min(low, z[i]), high = std::max(high, z[i]);
  Values values;
  std::vector<double> steps;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      if (is_missing(z[i]) || z[i] == z[i - 1] || z[i] == low || z[i] == high || z[i] == 0.0)
        continue;
      values.dps.push_back(z[i]);
      if (const double step = z[i] - known(i) - z[i - 1] + known(i - 1); !is_missing(step))
        steps.push_back(std::abs(step));
    }
  if (steps.empty()) return values;
  constexpr double most = 0.99;
  const double largest = quantile(steps, most);
  double sum = 0.0, count = 0.0;
  for (const double step : steps)
    if (step <= largest) sum += step, count += 1.0;
  const double of_steps = 0.5 * std::sqrt(std::numbers::pi) * sum / count;  // of normal ones
  const double middle = quantile(values.dps, 0.5);
  double total = 0.0;
  for (const double value : values.dps) total += std::abs(value - middle);
  const double of_values =
      std::sqrt(0.5 * std::numbers::pi) * total / static_cast<double>(values.dps.size());
  values.noise_dps = std::min(of_steps, of_values);
  return values;
}

/// Where the characteristic function of the values is clearly not 0, per dps; 0 where it is
/// nowhere.
double clearest_frequency(const Values& values, double resolution_dps) {
  constexpr double bins_of_noise = 64.0, lowest = 0.8, highest = 16.0;
  constexpr std::size_t most_bins = std::size_t{1} << 20;
  const auto [low, high] = std::minmax_element(values.dps.begin(), values.dps.end());
  double bin = values.noise_dps / bins_of_noise;
  // Each as wide as any other in multiples of the print.
  if (resolution_dps > 0.0) bin = resolution_dps * std::max(1.0, std::floor(bin / resolution_dps));
  if ((*high - *low) / bin >= static_cast<double>(most_bins)) return 0.0;
  std::vector<double> counts(2 * std::bit_ceil(static_cast<std::size_t>((*high - *low) / bin) + 2));
  for (const double value : values.dps)
    counts[static_cast<std::size_t>((value - *low + 0.5 * resolution_dps) / bin)] += 1.0;
  const double resolution = 1.0 / (bin * static_cast<double>(counts.size()));
  const auto first = static_cast<std::size_t>(lowest / (values.noise_dps * resolution));
  const auto last = std::min(counts.size() / 4,
                             static_cast<std::size_t>(highest / (values.noise_dps * resolution)));
  if (first >= last) return 0.0;
  // Of independent values without a grid each is exponential, of mean 1.
  auto power = powers_of(counts, first, last);
  for (double& p : power) p /= static_cast<double>(values.dps.size());
  const auto peak = std::max_element(power.begin(), power.end());
  constexpr double clear = 40.0;
  const double usual = std::max(1.0, quantile(power, 0.5) / std::numbers::ln2);
  if (*peak < clear * usual) return 0.0;
  return static_cast<double>(first + static_cast<std::size_t>(peak - power.begin())) * resolution;
}

/// Where the values are about multiples of the step, and by how much they miss these: by least
/// squares, begun from their mean direction.
BlurredGrid about(const std::vector<double>& values, double lsb_dps) {
  std::complex<double> sum;
  for (const double value : values)
    sum += std::polar(1.0, 2.0 * std::numbers::pi * std::fmod(value / lsb_dps, 1.0));
  BlurredGrid grid{lsb_dps, std::arg(sum) / (2.0 * std::numbers::pi) * lsb_dps, 0.0};
  const auto n = static_cast<double>(values.size());
  for (int pass = 0; pass < 4; ++pass) {
    double steps = 0.0, squares = 0.0, total = 0.0, product = 0.0, missed = 0.0;
    for (const double value : values) {
      const double step = std::nearbyint((value - grid.offset_dps) / grid.lsb_dps);
      const double off = value - grid.offset_dps - step * grid.lsb_dps;
      steps += step;
      squares += step * step;
      total += off;
      product += step * off;
      missed += off * off;
    }
    grid.noise_dps = std::sqrt(missed / n);
    const double spread = squares - steps * steps / n;
    if (!(spread > 0.0)) break;
    const double slope = (product - steps * total / n) / spread;
    grid.lsb_dps += slope;
    grid.offset_dps += (total - slope * steps) / n;
  }
  grid.offset_dps = std::remainder(grid.offset_dps, grid.lsb_dps);
  return grid;
}

/// Whether noise takes values from one of the grid to the next, as it does on any that is not far
/// coarser: a motion between a few rates does not.
bool is_crossed(const std::vector<double>& values, const BlurredGrid& grid) {
  constexpr double least = 0.02;
  double crossed = 0.0, before = 0.0;
  for (const double value : values) {
    const double step = std::nearbyint((value - grid.offset_dps) / grid.lsb_dps);
    crossed += std::abs(step - before) == 1.0 ? 1.0 : 0.0;
    before = step;
  }
  return crossed > least * static_cast<double>(values.size());
}

/// Of values on more levels than noise alone takes them to, those on neither end: what a limit
/// clips before the noise is about two values, as on a grid, wherever all others are.
std::vector<double> between_ends(const std::vector<double>& values, double lsb_dps) {
  constexpr double fewest_levels = 8.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*high - *low < fewest_levels * lsb_dps) return values;
  std::vector<double> between;
  for (const double value : values)
    if (value > *low + lsb_dps && value < *high - lsb_dps) between.push_back(value);
  return between;
}

/// How far values are from those of a grid, in its steps.
double share_missed(const std::vector<double>& values, const BlurredGrid& grid) {
  double squares = 0.0;
  for (const double value : values) {
    const double missed = (value - grid.nearest_dps(value)) / grid.lsb_dps;
    squares += missed * missed;
  }
  return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace

double BlurredGrid::nearest_dps(double value_dps) const {
  return offset_dps + lsb_dps * std::nearbyint((value_dps - offset_dps) / lsb_dps);
}

std::optional<BlurredGrid> blurred_grid(const Simulator& simulator,
                                        const std::vector<double>& gyro_dps) {
  const auto values = free_values(simulator.conditions(), gyro_dps);
  if (values.dps.size() < fewest_free_values || !(values.noise_dps > 0.0)) return std::nullopt;
  const double frequency = clearest_frequency(values, simulator.resolution_dps());
  if (frequency == 0.0) return std::nullopt;
  constexpr double most_blurred = 1.0 / 6.0, coarsest = 4.0, clear = 50.0;
  constexpr int most_harmonics = 8;
  std::optional<BlurredGrid> best;
  double most = clear / static_cast<double>(values.dps.size());
  for (int harmonic = 1; harmonic <= most_harmonics; ++harmonic) {
    const auto grid = about(values.dps, harmonic / frequency);
    const double share = grid.noise_dps / grid.lsb_dps;
    if (share > most_blurred || grid.lsb_dps > coarsest * values.noise_dps ||
        grid.lsb_dps < 4.0 * simulator.resolution_dps())
      continue;
    // Beside values that may be anywhere between two of the grid.
    const double gain = -std::log(share * std::sqrt(2.0 * std::numbers::pi)) - 0.5;
    if (gain <= most || !is_crossed(values.dps, grid)) continue;
    if (const auto between = between_ends(values.dps, grid.lsb_dps);
        between.size() < fewest_free_values || share_missed(between, grid) > most_blurred)
      continue;
    most = gain;
    best = grid;
  }
  return best;
}

}  // namespace gyrostat::gap
