#include <gyrostat/diagnosis/likelihood/resting_noise.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// In grids, as everything below.
double mean_of_rounded(const std::map<long, double>& counts) {
  double sum = 0.0, all = 0.0;
  for (const auto& [value, count] : counts) {
    sum += count * static_cast<double>(value);
    all += count;
  }
  return sum / all;
}

double share_of(long value, double level, double deviation) {
  const double at = static_cast<double>(value);
  return below(at + 0.5, level, deviation) - below(at - 0.5, level, deviation);
}

/// The level whose rounded noise has that mean.
double level_of(double mean, double deviation) {
  double low = mean - 1.0, high = mean + 1.0;
  for (int k = 0; k < 60; ++k) {
    const double level = 0.5 * (low + high);
    double rounded = 0.0;
    const long middle = std::lround(level);
    for (long value = middle - 6; value <= middle + 6; ++value)
      rounded += static_cast<double>(value) * share_of(value, level, deviation);
    (rounded < mean ? low : high) = level;
  }
  return 0.5 * (low + high);
}

double log_likelihood(const std::map<long, double>& counts, double level, double deviation) {
  double sum = 0.0;
  for (const auto& [value, count] : counts)
    sum += count * std::log(std::max(share_of(value, level, deviation), 1e-300));
  return sum;
}

}  // namespace

std::optional<RestingNoise> resting_noise(const Conditions& conditions,
                                          const std::vector<double>& gyro_dps, double lsb_dps) {
  if (!(lsb_dps > 0.0) || conditions.has_motion()) return std::nullopt;
  constexpr std::size_t blocks = 20, most_values = 5;
  constexpr double few = 1e-3, still = 0.1, alike = 0.01;
  std::map<long, double> counts;
  std::vector<double> values;
  double offset = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(gyro_dps[i])) {
        const double value = gyro_dps[i] / lsb_dps;
        if (values.empty()) offset = value - std::nearbyint(value);
        values.push_back(value - offset);
        counts[std::lround(values.back())] += 1.0;
        if (std::abs(values.back() - std::nearbyint(values.back())) > alike ||
            counts.size() > most_values)
          return std::nullopt;
      }
  if (values.size() < 50 * blocks || counts.size() < 2) return std::nullopt;
  const auto n = static_cast<double>(values.size());
  const auto common = std::count_if(counts.begin(), counts.end(),
                                    [&](const auto& c) { return c.second > few * n; });
  if (common > 3) return std::nullopt;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::size_t b = 0; b < blocks; ++b) {
    double sum = 0.0, count = 0.0;
    for (std::size_t k = b * values.size() / blocks; k < (b + 1) * values.size() / blocks; ++k)
      sum += values[k], count += 1.0;
    lowest = std::min(lowest, sum / count);
    highest = std::max(highest, sum / count);
  }
  if (highest - lowest > still) return std::nullopt;

  const double mean = mean_of_rounded(counts);
  constexpr double smallest = 0.05, largest = 1.0, step = 1.01, as_likely = 0.5;
  std::vector<std::pair<double, double>> tried;  // deviations, with their log-likelihoods
  double best = -std::numeric_limits<double>::infinity();
  for (double deviation = smallest; deviation < largest; deviation *= step) {
    tried.emplace_back(deviation, log_likelihood(counts, level_of(mean, deviation), deviation));
    best = std::max(best, tried.back().second);
  }
  double found = smallest;
  for (const auto& [deviation, likelihood] : tried)
    if (likelihood > best - as_likely) found = deviation;
  // A grid through zero has no offset but that of decimals.
  if (std::abs(offset) < alike) offset = 0.0;
  return RestingNoise{.level_dps = lsb_dps * (offset + level_of(mean, found)),
                      .std_dps = lsb_dps * found,
                      .offset_dps = lsb_dps * offset};
}

}  // namespace gyrostat::gap
