#include <gyrostat/diagnosis/likelihood/response_left.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/block_level.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/generators/effects/empirical_response.hpp>

namespace gyrostat::gap {
namespace {

using Weights = std::array<double, effects::EmpiricalResponse::samples>;

/// Second differences about all but the ends, which leave a rate that grows evenly as it is; last
/// the first about the middle, and the middle itself.
std::vector<Weights> shapes() {
  std::vector<Weights> all;
  constexpr std::size_t middle = Weights{}.size() / 2;
  for (std::size_t k = 1; k + 1 < Weights{}.size(); ++k) {
    Weights second{};
    second[k - 1] = second[k + 1] = 1.0;
    second[k] = -2.0;
    all.push_back(second);
  }
  Weights first{}, none{};
  first[middle - 1] = -0.5;
  first[middle + 1] = 0.5;
  none[middle] = 1.0;
  all.push_back(first);
  all.push_back(none);
  return all;
}

effects::EmpiricalResponse with_weights(const Weights& w) {
  return {w[0], w[1], w[2], w[3], w[4], w[5], w[6], w[7], w[8]};
}

/// How a set follows the rate in time.
struct Following {
  bool is_filtered = false, is_shifted = false;
  double delay_samples = 0.0;
  double beyond_samples = 0.0;  ///< of what is sensed, before the first or after the last
};

Following following(const Conditions& conditions, const Scenario& set) {
  Following f;
  for (const auto& effect : set.effects) {
    f.is_filtered |= effect.id() == "sensor_bandwidth";
    if (effect.id() != "time_offset") continue;
    f.is_shifted = true;
    const double shift = effect.value(field_of(effect, "offset_s")) / conditions.interval_s();
    f.delay_samples = std::round(shift);
    const double drifted =
        1e-6 * effect.value(field_of(effect, "drift_ppm")) * static_cast<double>(conditions.size());
    f.beyond_samples = std::max(std::abs(shift), std::abs(shift + drifted));
  }
  return f;
}

/// By least squares beside the set, of the first `taken` shapes.
std::optional<Effect> likeliest_response(const SetBench& bench, const Scenario& set,
                                         const std::vector<Weights>& all, std::size_t taken) {
  const auto& conditions = bench.conditions();
  Series sensed = conditions.series();
  sensed.rate_ref_dps = bench.sensed_rate(set);

  const auto left = bench.rate_left_by(set, bench.masked());
  std::vector<std::vector<double>> columns;
  for (const auto& shape : all) {
    sensed.gyro_dps.assign(sensed.size(), 0.0);
    with_weights(shape).apply(sensed, {});
    take_out_level(bench.conditions(), sensed.gyro_dps);
    columns.push_back(sensed.gyro_dps);
  }
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd with_left = Eigen::VectorXd::Zero(count), row(count);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      for (Eigen::Index c = 0; c < count; ++c) row[c] = columns[static_cast<std::size_t>(c)][i];
      if (is_missing(left[i]) || !row.allFinite()) continue;
      normal += row * row.transpose();
      with_left += left[i] * row;
    }
  // A motion of few frequencies has differences that are alike.
  normal.diagonal() *= 1.0 + 1e-6;
  if (!(normal.diagonal().minCoeff() > 0.0)) return std::nullopt;
  const Eigen::VectorXd sizes = solve_symmetric(normal, with_left);
  Weights weights{};
  for (std::size_t c = 0; c < taken; ++c)
    for (std::size_t k = 0; k < weights.size(); ++k)
      weights[k] += sizes[static_cast<Eigen::Index>(c)] * all[c][k];
  if (!std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); }))
    return std::nullopt;
  return with_weights(weights);
}

}  // namespace

bool is_of_response(std::string_view effect) {
  return effect == "sensor_bandwidth" || effect == "time_offset";
}

std::optional<Effect> response_left(const SetBench& bench, const Scenario& set) {
  const auto& conditions = bench.conditions();
  const auto follows = following(conditions, set);
  if (!follows.is_filtered && !follows.is_shifted) return std::nullopt;
  const auto all = shapes();
  // A scale and a shift are no response without a name: they are beside it.
  return likeliest_response(bench, set, all, all.size() - (follows.is_shifted ? 2 : 1));
}

std::optional<Effect> whole_response(const SetBench& bench, const Scenario& set) {
  const auto all = shapes();
  return likeliest_response(bench, set, all, all.size());
}

std::vector<char> samples_of_unknown_rate(const Conditions& conditions, const Scenario& set,
                                          double noise_dps) {
  const auto& rate = conditions.series().rate_ref_dps;
  std::vector<char> flags(conditions.size(), 0);
  const auto follows = following(conditions, set);
  if (rate.size() < 3 || (!follows.is_filtered && !follows.is_shifted)) return flags;
  const double most = 8.0 * 2.0 * noise_dps;
  const auto n = static_cast<std::ptrdiff_t>(rate.size());
  const auto delay = static_cast<std::ptrdiff_t>(follows.delay_samples);
  constexpr std::ptrdiff_t reach = 1;
  for (std::ptrdiff_t i = 1; i + 1 < n; ++i) {
    const auto at = [&](std::ptrdiff_t k) { return rate[static_cast<std::size_t>(k)]; };
    if (!(std::abs(at(i - 1) - 2.0 * at(i) + at(i + 1)) > most)) continue;
    for (std::ptrdiff_t k = i + delay - reach; k <= i + delay + reach; ++k)
      if (k >= 0 && k < n) flags[static_cast<std::size_t>(k)] = 1;
  }
  // A motion that is hardly anywhere known would leave too little.
  constexpr std::ptrdiff_t most_of = 4;
  if (most_of * std::count(flags.begin(), flags.end(), char{1}) >= n)
    std::fill(flags.begin(), flags.end(), char{0});
  return flags;
}

std::vector<char> samples_shifted_beyond(const Conditions& conditions, const Scenario& set) {
  std::vector<char> flags(conditions.size(), 0);
  const auto beyond = std::min(
      static_cast<std::size_t>(std::ceil(following(conditions, set).beyond_samples)), flags.size());
  std::fill_n(flags.begin(), beyond, char{1});
  std::fill_n(flags.rbegin(), beyond, char{1});
  return flags;
}

}  // namespace gyrostat::gap
