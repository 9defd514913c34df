#include <gyrostat/diagnosis/likelihood/rate_grid.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

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
    const double mean = k == 0 ? 1.0 : std::sin(0.5 * m * angle) / (m * std::sin(0.5 * angle));
    const double weight = k == 0 || k == bins - 1 ? 0.5 : 1.0;
    of_a_mean_.push_back(weight * mean * mean * resolution_hz_);
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
  constexpr std::size_t every = 7;  // a sample of the pairs tells their shares well enough
  pairs_.assign(bins, 0.0);
  std::vector<double> pairs_of_all(bins, 0.0);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; i += every)
      for (std::size_t lag = 0; lag < bins && i + lag < span.last; ++lag) {
        pairs_of_all[lag] += 1.0;
        pairs_[lag] += masked_[i] == 0 && masked_[i + lag] == 0 ? 1.0 : 0.0;
      }
  for (std::size_t lag = 0; lag < bins; ++lag) pairs_[lag] /= std::max(pairs_of_all[lag], 1.0);
}

std::vector<double> RateGrid::shown(const std::vector<double>& density) const {
  if (pairs_.empty()) return density;
  // The covariance of a product of independent series is the product of their covariances.
  auto covariance = density;
  std::fill_n(covariance.begin(), first_fast_bin_ / 2, 0.0);
  covariance = cosine_sums(covariance);
  const auto period = static_cast<double>(segment());
  for (std::size_t lag = 0; lag < covariance.size(); ++lag) covariance[lag] *= pairs_[lag] / period;
  auto seen = cosine_sums(covariance);
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = std::max(seen[k], 1e-6 * density[k]);
  return seen;
}

}  // namespace gyrostat::gap
