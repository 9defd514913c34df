#include <gyrostat/diagnosis/likelihood/reduced_rate.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/analysis/spectra/welch.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

/// A straight line from the middle of each run of clusters of one part to the next's.
std::vector<double> smoothed(const Conditions& conditions, const std::vector<double>& means) {
  const std::size_t cluster = conditions.cluster(), size = conditions.size();
  const auto count = static_cast<std::ptrdiff_t>(means.size());
  const auto reach = static_cast<std::ptrdiff_t>(clusters_of_level / 2);
  std::vector<double> local(means.size(), 0.0);
  const auto part = [&](std::size_t k) { return conditions.part_of(k * cluster); };
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    double sum = 0.0, number = 0.0;
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, k - reach);
         j <= std::min(count - 1, k + reach); ++j)
      if (!is_missing(means[static_cast<std::size_t>(j)]) &&
          part(static_cast<std::size_t>(j)) == part(static_cast<std::size_t>(k))) {
        sum += means[static_cast<std::size_t>(j)];
        number += 1.0;
      }
    local[static_cast<std::size_t>(k)] = number > 0.0 ? sum / number : 0.0;
  }
  std::vector<char> goes_on(means.size(), 0);
  for (std::size_t k = 0; k < means.size(); ++k)
    goes_on[k] = part(k) == part(std::min(k + 1, means.size() - 1)) ? 1 : 0;
  std::vector<double> level(size);
  std::size_t low = 0, own = 0;  // the mean before a sample, and that of its cluster
  for (std::size_t i = 0; i < size; ++i) {
    const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(cluster) - 0.5;
    while (low + 1 < means.size() && at >= static_cast<double>(low + 1)) ++low;
    while (own + 1 < means.size() && i >= (own + 1) * cluster) ++own;
    const std::size_t high = std::min(low + 1, means.size() - 1);
    const double share = std::clamp(at - static_cast<double>(low), 0.0, 1.0);
    level[i] = goes_on[low] != 0 ? local[low] + share * (local[high] - local[low]) : local[own];
  }
  return level;
}

}  // namespace

ReducedRate::ReducedRate(const Conditions& conditions, std::vector<double> error_dps,
                         std::shared_ptr<const RateGrid> grid,
                         const std::vector<double>& of_means_dps)
    : grid_(std::move(grid)),
      cluster_s_(conditions.slow_interval_s()),
      is_beside_motion_(conditions.has_motion()) {
  std::vector<double> values = std::move(error_dps);
  const auto& masked = grid_->counted().masked();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (masked[i] != 0) values[i] = no_value;
  const auto means = conditions.slow_means(values);
  // Of a cluster, half the samples at least must count; of a slower clock, half of its own.
  const double least_share = grid_->counted().come_evenly() ? 0.5 * grid_->counted().share() : 0.5;
  const auto share_of = [&](std::size_t mean) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(mean * conditions.cluster());
    const auto there =
        std::count_if(first, first + static_cast<std::ptrdiff_t>(conditions.cluster()),
                      [](double value) { return !is_missing(value); });
    return static_cast<double>(there) / static_cast<double>(conditions.cluster());
  };
  double inverse_shares = 0.0, points = 0.0;
  for (const Part part : both_parts) {
    auto& slow = slow_[index_of(part)];
    for (const auto& span : conditions.slow_spans(part))
      for (std::size_t i = span.first; i < span.last; ++i)
        if (const double share = share_of(i); share > 0.0 && share >= least_share) {
          slow.points.push_back(i);
          inverse_shares += 1.0 / share;
          points += 1.0;
        }
    slow.means.resize(static_cast<Eigen::Index>(slow.points.size()));
    for (std::size_t k = 0; k < slow.points.size(); ++k)
      slow.means[static_cast<Eigen::Index>(k)] =
          means[slow.points[k]] + (of_means_dps.empty() ? 0.0 : of_means_dps[slow.points[k]]);
  }
  if (points > 0.0)
    noise_of_means_ =
        inverse_shares / points * (grid_->counted().come_evenly() ? grid_->counted().share() : 1.0);
  if (!grid_->counted().are_all()) {
    const auto level = smoothed(conditions, means);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = is_missing(values[i]) ? 0.0 : values[i] - level[i];
    for (std::size_t i = 0; i < values.size(); ++i)
      if (grid_->counted().is_halfway(i)) values[i] = 0.5 * (values[i - 1] + values[i + 1]);
  }
  reduce_fast(conditions, values);
}

double ReducedRate::white_std_dps() const {
  const auto& density = periodogram();
  if (density.empty()) {
    const auto& means = slow(Part::train).means;
    if (means.size() < 2) return 0.0;
    const auto count = means.size() - 1;
    const double squares = (means.tail(count) - means.head(count)).squaredNorm();
    return std::sqrt(0.5 * squares / static_cast<double>(count));
  }
  double sum = 0.0, bins = 0.0;
  for (std::size_t k = grid_->first_fast_bin(); k + 1 < density.size(); ++k)
    sum += density[k], bins += 1.0;
  const double nyquist_hz = grid_->resolution_hz() * static_cast<double>(density.size() - 1);
  return std::sqrt(sum / bins * nyquist_hz / std::max(grid_->counted().share(), 0.05));
}

void ReducedRate::reduce_fast(const Conditions& conditions, const std::vector<double>& error_dps) {
  const std::size_t length = grid_->segment();
  std::vector<std::span<const double>> stretches;
  double samples = 0.0;
  for (const auto& span : conditions.spans(Part::train)) {
    if (span.size() < length) continue;
    stretches.emplace_back(error_dps.data() + span.first, span.size());
    samples += static_cast<double>(span.size());
  }
  periodogram_ = welch(stretches, conditions.rate_hz(), length, length / 2).density;
  degrees_ = grid_->counted().share() * samples / static_cast<double>(length);
}

}  // namespace gyrostat::gap
