#include <gyrostat/diagnosis/likelihood/rate_grid.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

namespace gyrostat::gap {
namespace {

constexpr std::size_t shortest_segment = 64, longest_segment = 4096;
constexpr std::size_t segments_wanted = 32;

std::size_t segment_length(const Conditions& conditions) {
  std::size_t samples = 0, longest = 0;
  for (const auto& span : conditions.spans(Part::train)) {
    samples += span.size();
    longest = std::max(longest, span.size());
  }
  const std::size_t wanted =
      std::clamp(samples / segments_wanted, shortest_segment, longest_segment);
  return std::bit_floor(std::max(shortest_segment, std::min(wanted, longest / 2)));
}

/// Of a mean over so many samples.
double mean_gain(double angle, double samples) {
  return angle == 0.0 ? 1.0 : std::sin(0.5 * samples * angle) / (samples * std::sin(0.5 * angle));
}

/// Share of a density that subtracting a level leaves: straight lines from the middle of each
/// cluster to the next's, of means over several.
std::vector<double> left_beside_level(const Angles& angles, std::size_t cluster) {
  const auto m = static_cast<double>(cluster);
  std::vector<double> left;
  for (const double angle : angles.values) {
    const double straight = mean_gain(angle, m);
    const double amplitude =
        1.0 - mean_gain(angle, static_cast<double>(clusters_of_level) * m) * straight * straight;
    left.push_back(amplitude * amplitude);
  }
  return left;
}

/// As the window of a periodogram shows it.
std::vector<double> smeared(const std::vector<double>& density) {
  auto seen = density;
  const std::size_t last = density.size() - 1;
  for (std::size_t k = 0; k <= last; ++k)
    seen[k] =
        (4.0 * density[k] + density[k == 0 ? 1 : k - 1] + density[k == last ? k - 1 : k + 1]) / 6.0;
  return seen;
}

}  // namespace

Angles::Angles(std::size_t bins) {
  for (std::size_t k = 0; k < bins; ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(bins - 1);
    values.push_back(angle);
    cosines.push_back(std::cos(angle));
    sines.push_back(std::sin(angle));
  }
}

RateGrid::RateGrid(const Conditions& conditions, std::vector<char> masked)
    : angles_(segment_length(conditions) / 2 + 1),
      counted_(conditions, std::move(masked), angles_.values.size()) {
  resolution_hz_ = conditions.rate_hz() / static_cast<double>(segment());
  const std::size_t bins = angles_.values.size();
  const auto m = static_cast<double>(conditions.cluster());
  for (std::size_t k = 0; k < bins; ++k) {
    const double angle = angles_.values[k];
    const double mean = mean_gain(angle, m);
    const double weight = k == 0 || k == bins - 1 ? 0.5 : 1.0;
    of_a_mean_.push_back(weight * mean * mean * resolution_hz_);
    for (std::size_t lag = 0; lag < of_neighbours_.size(); ++lag)
      of_neighbours_[lag].push_back(of_a_mean_.back() *
                                    std::cos(static_cast<double>(lag + 1) * m * angle));
  }
  const double lowest_hz = 0.5 / conditions.slow_interval_s();
  first_fast_bin_ =
      std::max<std::size_t>(3, static_cast<std::size_t>(std::ceil(lowest_hz / resolution_hz_)));
  if (!counted_.come_evenly()) return;
  left_of_level_ = left_beside_level(angles_, conditions.cluster());
  seen_of_level_ = smeared(left_of_level_);
}

double RateGrid::variance_of_a_mean(const std::vector<double>& density) const {
  const auto sum = [&](const std::vector<double>& of) {
    return std::inner_product(of.begin(), of.end(), of_a_mean_.begin(), 0.0);
  };
  if (!counted_.come_evenly()) return sum(density);
  return sum(counted_.density(density)) / (counted_.share() * counted_.share());
}

std::array<double, 2> RateGrid::covariances_of_means(const std::vector<double>& density) const {
  std::array<double, 2> covariances;
  for (std::size_t lag = 0; lag < covariances.size(); ++lag)
    covariances[lag] =
        std::inner_product(density.begin(), density.end(), of_neighbours_[lag].begin(), 0.0);
  return covariances;
}

std::vector<double> RateGrid::shown(const std::vector<double>& density) const {
  if (counted_.are_all_of_train()) return density;
  const std::size_t slow_bins = first_fast_bin_ / 2;
  auto fast = density;
  std::vector<double> seen;
  if (!counted_.come_evenly()) {
    // What is slow goes with the level.
    std::fill_n(fast.begin(), slow_bins, 0.0);
    seen = counted_.density(std::move(fast));
  } else {
    // The level is that of the samples that count, and is taken out of these alone: with it goes
    // what their gaps fold down.
    std::fill_n(fast.begin(), slow_bins, density[slow_bins]);
    const auto folded = counted_.density(fast);
    auto taken = seen_of_level_;
    const double kept = counted_.share();
    for (std::size_t k = 0; k < taken.size(); ++k)
      taken[k] = (1.0 - taken[k]) * folded[k] / (kept * kept);
    // Of what is stronger the slower it is, the window shows what the level leaves.
    std::vector<double> slow(density.size(), 0.0);
    for (std::size_t k = 1; k < slow_bins; ++k)
      slow[k] = left_of_level_[k] * std::max(0.0, density[k] - density[slow_bins]);
    slow = smeared(slow);
    for (std::size_t k = 0; k < fast.size(); ++k) fast[k] += slow[k] - taken[k];
    seen = counted_.density(std::move(fast));
  }
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = std::max(seen[k], 1e-6 * density[k]);
  return seen;
}

}  // namespace gyrostat::gap
