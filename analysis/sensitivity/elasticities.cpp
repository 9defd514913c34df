#include <numeric>

#include <gyrostat/analysis/sensitivity/estimators.hpp>
#include <gyrostat/analysis/sensitivity/paired_trials.hpp>

namespace gyrostat {
namespace {

double mean_of(const Outputs& outputs, std::size_t point) {
  double sum = 0.0;
  const auto trials = common_trials(outputs, {point});
  for (const auto t : trials) sum += outputs.at(point, t);
  return sum / static_cast<double>(trials.size());
}

/// Trials of a numerator and a denominator.
struct Pairs {
  std::vector<double> above, below;

  double mean(const std::vector<double>& v) const {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  }
  /// Of the means of two columns.
  double covariance(const std::vector<double>& v, const std::vector<double>& w) const {
    const auto n = static_cast<double>(v.size());
    const double at = mean(v), there = mean(w);
    double sum = 0.0;
    for (std::size_t t = 0; t < v.size(); ++t) sum += (v[t] - at) * (w[t] - there);
    return sum / (n * (n - 1.0));
  }
};

/// The ratio r of the means with the interval of all r at which above - r below has a mean of zero
/// within its error (Fieller, J. R. Stat. Soc. B 16, 1954), with the bootstrap-t's quantiles in
/// place of Student's. No interval where the denominator's mean may itself be zero.
Estimate ratio(const Pairs& pairs, Resampler& resampler) {
  const double above = pairs.mean(pairs.above), below = pairs.mean(pairs.below);
  Estimate estimate{.value = above / below};
  CrossedRows rests(1, 0);
  for (std::size_t t = 0; t < pairs.above.size(); ++t)
    rests.add({{pairs.above[t] - estimate.value * pairs.below[t]}});
  const auto rest = bootstrapped(
      rests, [](auto m) { return m[0]; }, resampler);
  const double aa = pairs.covariance(pairs.above, pairs.above),
               bb = pairs.covariance(pairs.below, pairs.below),
               ab = pairs.covariance(pairs.above, pairs.below);
  const double variance = aa - 2.0 * estimate.value * ab + estimate.value * estimate.value * bb;
  // The ends solve (above - r below)^2 = q^2 (aa - 2 r ab + r^2 bb).
  const auto end = [&](double quantile_times_error, double side) {
    const double q2 = variance > 0.0 ? quantile_times_error * quantile_times_error / variance : 0.0;
    const double a = below * below - q2 * bb, b = above * below - q2 * ab;
    const double discriminant = q2 * (below * below * aa - 2.0 * above * below * ab +
                                      above * above * bb - q2 * (aa * bb - ab * ab));
    return a > 0.0 ? (b + side * std::sqrt(std::max(0.0, discriminant))) / a : no_value;
  };
  const double direction = below > 0.0 ? 1.0 : -1.0;
  estimate.low = end(direction > 0.0 ? rest.low : rest.high, -1.0);
  estimate.high = end(direction > 0.0 ? rest.high : rest.low, 1.0);
  return estimate;
}

}  // namespace

std::vector<Elasticity> elasticities(const Outputs& outputs, std::span<const Excursion> excursions,
                                     Resampler& resampler) {
  std::vector<Elasticity> all;
  for (std::size_t p = 0; p < excursions.size(); ++p) {
    const auto& excursion = excursions[p];
    const std::size_t low = 1 + 2 * p, high = low + 1;
    Pairs pairs;
    for (const auto t : common_trials(outputs, {0, low, high})) {
      pairs.above.push_back(excursion.base * (outputs.at(high, t) - outputs.at(low, t)) /
                            (excursion.high - excursion.low));
      pairs.below.push_back(outputs.at(0, t));
    }
    Elasticity elasticity;
    elasticity.value = ratio(pairs, resampler);
    elasticity.low_output = mean_of(outputs, low);
    elasticity.high_output = mean_of(outputs, high);
    all.push_back(elasticity);
  }
  return all;
}

}  // namespace gyrostat
