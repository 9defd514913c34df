#include <gyrostat/diagnosis/likelihood/rate_grid.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gyrostat/analysis/spectra/cosine_sums.hpp>

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

/// Whether pairs of samples that count, of which so many were looked at, are as likely far apart as
/// evenly hidden ones make them.
bool come_evenly(const std::vector<double>& pairs, double looked_at) {
  constexpr double clear = 6.0;  // standard deviations
  const double kept = pairs.front(), chance = kept * kept;
  const double apart = 0.5 * (kept - chance);
  const auto half = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
  return *std::max_element(half, pairs.end()) > chance + apart &&
         apart > clear * std::sqrt(chance * (1.0 - chance) / looked_at);
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
    : masked_(std::move(masked)),
      angles_(segment_length(conditions) / 2 + 1),
      hides_any_(std::find(masked_.begin(), masked_.end(), char{1}) != masked_.end()) {
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

  double hidden = 0.0, all = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      hidden += masked_[i] != 0 ? 1.0 : 0.0;
      all += 1.0;
    }
  kept_ = all > 0.0 ? 1.0 - hidden / all : 1.0;
  if (kept_ == 1.0) return;
  // Some of the pairs tell their shares well enough; where one of seven samples counts, or of
  // fourteen, it must not be that one.
  const double every = kept_ < 0.2 ? 7.0 + 1.0 / std::numbers::phi : 7.0;
  pairs_.assign(bins, 0.0);
  std::vector<double> pairs_of_all(bins, 0.0);
  for (const auto& span : conditions.spans(Part::train))
    for (double at = 0.0; at < static_cast<double>(span.size()); at += every) {
      const std::size_t i = span.first + static_cast<std::size_t>(at);
      for (std::size_t lag = 0; lag < bins && i + lag < span.last; ++lag) {
        pairs_of_all[lag] += 1.0;
        pairs_[lag] += masked_[i] == 0 && masked_[i + lag] == 0 ? 1.0 : 0.0;
      }
    }
  for (std::size_t lag = 0; lag < bins; ++lag) pairs_[lag] /= std::max(pairs_of_all[lag], 1.0);
  comes_evenly_ = come_evenly(pairs_, pairs_of_all.back());
  if (!comes_evenly_) {
    put_halfway(conditions);
    return;
  }
  left_of_level_ = left_beside_level(angles_, conditions.cluster());
  seen_of_level_ = smeared(left_of_level_);
}

void RateGrid::put_halfway(const Conditions& conditions) {
  halfway_.assign(masked_.size(), 0);
  const std::size_t lags = pairs_.size();
  beside_halfway_.assign(lags, 0.0);
  both_halfway_.assign(lags, 0.0);
  std::vector<double> pairs_of_all(lags, 0.0);
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part)) {
      for (std::size_t i = span.first + 1; i + 1 < span.last; ++i)
        halfway_[i] = masked_[i] != 0 && masked_[i - 1] == 0 && masked_[i + 1] == 0 ? 1 : 0;
      if (part != Part::train) continue;
      for (std::size_t lag = 0; lag < std::min(lags, span.size()); ++lag)
        pairs_of_all[lag] += static_cast<double>(span.size() - lag);
      for (std::size_t i = span.first; i < span.last; ++i) {
        if (halfway_[i] == 0) continue;
        for (std::size_t lag = 0; lag < lags && i + lag < span.last; ++lag) {
          both_halfway_[lag] += halfway_[i + lag] != 0 ? 1.0 : 0.0;
          beside_halfway_[lag] += masked_[i + lag] == 0 ? 0.5 : 0.0;
        }
        for (std::size_t lag = 0; lag < lags && i >= span.first + lag; ++lag)
          beside_halfway_[lag] += masked_[i - lag] == 0 ? 0.5 : 0.0;
      }
    }
  for (auto* shares : {&beside_halfway_, &both_halfway_})
    for (std::size_t lag = 0; lag < lags; ++lag) (*shares)[lag] /= std::max(pairs_of_all[lag], 1.0);
}

std::vector<double> RateGrid::masked_density(std::vector<double> density) const {
  // The covariance of a product of independent series is the product of their covariances.
  const auto covariance = cosine_sums(density);
  const auto last = static_cast<std::ptrdiff_t>(covariance.size()) - 1;
  const auto at = [&](std::ptrdiff_t lag) {
    return covariance[static_cast<std::size_t>(last - std::abs(last - std::abs(lag)))];
  };
  std::vector<double> shown(covariance.size());
  for (std::ptrdiff_t lag = 0; lag <= last; ++lag) {
    const auto k = static_cast<std::size_t>(lag);
    shown[k] = pairs_[k] * at(lag);
    if (!halfway_.empty())
      shown[k] += beside_halfway_[k] * (at(lag - 1) + at(lag + 1)) +
                  0.25 * both_halfway_[k] * (at(lag - 2) + 2.0 * at(lag) + at(lag + 2));
    shown[k] /= static_cast<double>(segment());
  }
  return cosine_sums(shown);
}

double RateGrid::variance_of_a_mean(const std::vector<double>& density) const {
  const auto sum = [&](const std::vector<double>& of) {
    return std::inner_product(of.begin(), of.end(), of_a_mean_.begin(), 0.0);
  };
  return comes_evenly_ ? sum(masked_density(density)) / (kept_ * kept_) : sum(density);
}

std::array<double, 2> RateGrid::covariances_of_means(const std::vector<double>& density) const {
  std::array<double, 2> covariances;
  for (std::size_t lag = 0; lag < covariances.size(); ++lag)
    covariances[lag] =
        std::inner_product(density.begin(), density.end(), of_neighbours_[lag].begin(), 0.0);
  return covariances;
}

std::vector<double> RateGrid::shown(const std::vector<double>& density) const {
  if (pairs_.empty()) return density;
  const std::size_t slow_bins = first_fast_bin_ / 2;
  auto fast = density;
  std::vector<double> seen;
  if (!comes_evenly_) {
    // What is slow goes with the level.
    std::fill_n(fast.begin(), slow_bins, 0.0);
    seen = masked_density(std::move(fast));
  } else {
    // The level is that of the samples that count, and is taken out of these alone: with it goes
    // what their gaps fold down.
    std::fill_n(fast.begin(), slow_bins, density[slow_bins]);
    const auto folded = masked_density(fast);
    auto taken = seen_of_level_;
    for (std::size_t k = 0; k < taken.size(); ++k)
      taken[k] = (1.0 - taken[k]) * folded[k] / (kept_ * kept_);
    // Of what is stronger the slower it is, the window shows what the level leaves.
    std::vector<double> slow(density.size(), 0.0);
    for (std::size_t k = 1; k < slow_bins; ++k)
      slow[k] = left_of_level_[k] * std::max(0.0, density[k] - density[slow_bins]);
    slow = smeared(slow);
    for (std::size_t k = 0; k < fast.size(); ++k) fast[k] += slow[k] - taken[k];
    seen = masked_density(std::move(fast));
  }
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = std::max(seen[k], 1e-6 * density[k]);
  return seen;
}

}  // namespace gyrostat::gap
