#include <gyrostat/analysis/fits/random_error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/analysis/fits/arima_moments.hpp>
#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t fewest_means = 100;
constexpr std::size_t least_cluster = 8;
constexpr std::size_t longest_cluster = 128;
constexpr double least_share_of_noise = 0.5;
/// Longer ones are not fitted sample by sample: a fit takes hundreds of passes over its samples.
constexpr std::size_t longest_fitted_whole = std::size_t{1} << 20;
constexpr std::size_t longest_fitted = std::size_t{1} << 18;

/// Of clusters of which at least half is present; NaN for the others.
std::vector<double> means_over(std::span<const double> rate, std::size_t cluster) {
  std::vector<double> means;
  for (std::size_t first = 0; first + cluster <= rate.size(); first += cluster) {
    double sum = 0.0, count = 0.0;
    for (const double value : rate.subspan(first, cluster))
      if (!is_missing(value)) sum += value, count += 1.0;
    means.push_back(2.0 * count >= static_cast<double>(cluster) ? sum / count : no_value);
  }
  return means;
}

/// Whether an Allan variance halves from one octave to the next, as that of white noise does.
bool falls_as_white_noise(double shorter, double longer) {
  const double octaves = std::log2(longer / shorter);
  return octaves > -1.25 && octaves < -0.75;
}

/// What a fit of means says of single samples.
ArimaFit of_samples(ArimaFit fit, std::size_t cluster) {
  const double root = std::sqrt(static_cast<double>(cluster));
  const std::array<double, 4> units = {1.0, 1.0 / root, 1.0 / root, root};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) fit.covariance[i][j] *= units[i] * units[j];
  for (auto* p : {&fit.parameters, &fit.standard_errors}) {
    p->delta1_dps /= root;
    p->delta2_dps /= root;
    p->measurement_noise_std_dps *= root;
  }
  fit.cluster = cluster;
  return fit;
}

ArimaFit fit_with(FitMethod method, std::span<const double> rate) {
  return method == FitMethod::likelihood ? fit_arima_likelihood(rate) : fit_arima_moments(rate);
}

/// A random walk in white noise, fitted to means.
ArimaFit walk_of_means(std::span<const double> rate, FitMethod method, std::size_t cluster) {
  const auto means = means_over(rate, cluster);
  const bool by_moments = method == FitMethod::moments && means.size() >= fewest_for_moments;
  auto walk =
      of_samples(by_moments ? fit_walk_moments(means) : fit_walk_likelihood(means), cluster);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  walk.standard_errors.phi = walk.standard_errors.delta2_dps = infinity;
  walk.covariance[0] = walk.covariance[2] = {0.0, 0.0, 0.0, 0.0};
  for (auto& row : walk.covariance) row[0] = row[2] = 0.0;
  walk.covariance[0][0] = walk.covariance[2][2] = infinity;
  walk.samples = rate.size();
  if (walk.converged) walk.message = "converged";
  return walk;
}

std::string of_means_over(std::size_t cluster) {
  return "delta1 and R are of means over " + std::to_string(cluster) + " samples";
}
constexpr const char* not_told = "phi and delta2 cannot be told and are held at 0";

/// A memory of samples is told by a stretch in the middle, a walk by means over all of it.
ArimaFit fit_of_long(std::span<const double> rate, FitMethod method) {
  const std::size_t first = (rate.size() - longest_fitted) / 2;
  const auto middle = rate.subspan(first, longest_fitted);
  auto fit = fit_random_error(middle, method);
  // Chi-squared of two parameters more than a walk's, at 1 %.
  constexpr double clear = 9.21;
  if (fit.cluster == 1 &&
      2.0 * (arima_log_likelihood(fit.parameters, middle) - fit_walk_likelihood(middle).objective) >
          clear) {
    fit.first = first;
    fit.message += "; fitted to the " + std::to_string(longest_fitted) +
                   " samples in the middle, which tell a memory as short as that";
    return fit;
  }
  const std::size_t least = (rate.size() + longest_fitted - 1) / longest_fitted;
  const std::size_t cluster = fit.cluster * ((least + fit.cluster - 1) / fit.cluster);
  auto walk = walk_of_means(rate, method, cluster);
  walk.message += "; " + of_means_over(cluster) + "; " + not_told;
  if (fit.cluster > 1) walk.message += "; the noise is coloured";
  return walk;
}

}  // namespace

WhiteMeans white_means(std::span<const double> rate) {
  std::vector<std::size_t> clusters;
  for (std::size_t m = 1; m <= 2 * longest_cluster && rate.size() / m >= fewest_means; m *= 2)
    clusters.push_back(m);
  if (clusters.size() < 2) return {0, 0.0};
  // Robust: outliers are white, too, and moments do not follow them.
  const auto variances = robust_allan_variances(without_spikes(rate), clusters);
  std::size_t white_from = 0;
  for (std::size_t k = 0; k + 1 < clusters.size(); ++k) {
    const std::size_t m = clusters[k];
    if (!falls_as_white_noise(variances[k], variances[k + 1]))
      white_from = 0;
    else if (white_from == 0)
      white_from = m;
    // Twice as long, what is left of the noise's memory hardly matters.
    if (white_from > 0 && m >= std::max(least_cluster, 2 * white_from))
      return {m, std::sqrt(static_cast<double>(m) * variances[k])};
  }
  return {0, 0.0};
}

ArimaFit fit_random_error(std::span<const double> rate, FitMethod method) {
  if (rate.size() > longest_fitted_whole) return fit_of_long(rate, method);
  const auto fit = fit_with(method, rate);
  const auto [cluster, white] = white_means(rate);
  const double R = std::pow(fit.parameters.measurement_noise_std_dps, 2);
  if (cluster == 0 || R >= least_share_of_noise * white * white) return fit;
  auto walk = walk_of_means(rate, method, cluster);
  walk.message += "; the noise is coloured: " + of_means_over(cluster) +
                  ", R as of white noise with the same density at low frequencies; " + not_told +
                  ". gyrostat diagnose says what colours it";
  return walk;
}

}  // namespace gyrostat
