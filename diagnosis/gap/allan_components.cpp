#include <gyrostat/diagnosis/gap/allan_components.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <gyrostat/analysis/search/box_search.hpp>
#include <gyrostat/analysis/spectra/arima_haar.hpp>
#include <gyrostat/diagnosis/gap/local_level.hpp>

namespace gyrostat::gap {
namespace {

struct Target {
  std::size_t cluster;
  double log_variance, error;
  double walk_left;
};

std::vector<Target> targets(const Conditions& conditions, const Scene& scene) {
  std::vector<Target> all;
  const auto add = [&](const Octave& octave, std::size_t unit, double walk_left) {
    if (!(octave.mean_square > 0.0)) return;
    const double degrees = std::max(1.0, 0.6 * static_cast<double>(octave.count));
    all.push_back({octave.cluster * unit, std::log(0.5 * octave.mean_square),
                   std::sqrt(2.0 / degrees + 1e-4), walk_left});
  };
  for (const auto& octave : scene.octaves[0])
    if (octave.cluster < conditions.cluster()) add(octave, 1, 1.0);
  const auto& slow = scene.slow_octaves[0];
  for (std::size_t level = 0; level < slow.size(); ++level)
    add(slow[level], conditions.cluster(), conditions.walk_left()[level]);
  return all;
}

/// An unknown effect adds variance. So a model that lies below the data by more than the sampling
/// error may be right, one that lies above is wrong.
double from_below(double square) {
  return square < 4.0 ? square : 4.0 + 4.0 * std::log(square / 4.0);
}

}  // namespace

double gauss_markov_allan_variance(double u) {
  if (u < 1e-3) return (2.0 / 3.0 - 0.5 * u) * u;
  return 2.0 * (1.0 - (3.0 - 4.0 * std::exp(-u) + std::exp(-2.0 * u)) / (2.0 * u)) / u;
}

AllanComponents fit_allan_components(const Conditions& conditions, const Scene& scene,
                                     SlowComponent component, bool with_walk) {
  const double interval_s = conditions.interval_s();
  const auto all = targets(conditions, scene);
  AllanComponents best;
  best.misfit = std::numeric_limits<double>::infinity();
  if (all.empty()) return best;
  const double white = std::sqrt(std::exp(all.front().log_variance));
  const double longest_s = interval_s * static_cast<double>(all.back().cluster);
  constexpr std::array memories = {std::array{0.0, 0.0},  std::array{0.8, 0.0},
                                   std::array{0.8, 0.7},  std::array{0.8, 0.93},
                                   std::array{0.95, 0.8}, std::array{0.95, 0.98}};
  // The longest octaves have few differences; where the walk is all there is, its likelihood knows
  // more of it.
  const auto m = static_cast<double>(conditions.cluster());
  std::optional<RatioLikelihood> level;
  if (component == SlowComponent::none)
    level.emplace(conditions.train_points(), conditions.train_regressors(),
                  conditions.train_values(scene.slow_dps));
  const auto without_other = [&](double white_dps, double walk_dps) {
    if (!level) return 0.0;
    const double ratio = std::pow(m * walk_dps / white_dps, 2);
    const double deviance = level->deviance(ratio);
    return ratio > level->most_likely() ? deviance : from_below(deviance);
  };
  for (const auto& [phi, theta] : memories) {
    const Arima111<double> unit{
        .phi = phi, .delta1_dps = 1.0, .delta2_dps = theta, .measurement_noise_std_dps = 0.0};
    std::vector<double> walk;
    for (const auto& target : all)
      walk.push_back(target.walk_left * arima_allan_variance(unit, target.cluster));
    const auto misfit = [&](const std::vector<double>& p) {
      double sum = 0.0;
      for (std::size_t k = 0; k < all.size(); ++k) {
        double variance = p[0] * p[0] / static_cast<double>(all[k].cluster) + p[1] * p[1] * walk[k];
        if (component == SlowComponent::flicker)
          variance += p[2] * p[2] * 2.0 * std::numbers::ln2 / std::numbers::pi;
        if (component == SlowComponent::gauss_markov)
          variance +=
              p[2] * p[2] *
              gauss_markov_allan_variance(interval_s * static_cast<double>(all[k].cluster) / p[3]);
        const double z = (std::log(variance) - all[k].log_variance) / all[k].error;
        sum += z > 0.0 ? z * z : from_below(z * z);
      }
      return sum + without_other(p[0], (1.0 - theta) / (1.0 - phi) * p[1]);
    };
    const double step = std::sqrt(walk.back() / all.back().walk_left);
    std::vector<SearchRange> ranges = {
        {0.3 * white, 1.5 * white},
        {1e-5 * white / step, (with_walk ? 10.0 : 2e-5) * white / step}};
    if (component != SlowComponent::none) ranges.push_back({1e-4 * white, 3.0 * white});
    SearchResult found;
    if (component != SlowComponent::gauss_markov) {
      found = box_search(ranges, 300 * static_cast<int>(ranges.size()), misfit);
    } else {  // the misfit has a valley for each correlation time
      const double shortest_s = std::max(0.5, 5.0 * interval_s);
      ranges.push_back({});
      for (double time_s = shortest_s; time_s < std::max(2.0 * shortest_s, 3.0 * longest_s);
           time_s *= 2.0) {
        ranges[3] = {time_s, 2.0 * time_s};
        if (const auto tried = box_search(ranges, 250, misfit);
            !(tried.objective >= found.objective))
          found = tried;
      }
    }
    if (!(found.objective < best.misfit)) continue;
    best = {.random_error = {.phi = phi,
                             .delta1_dps = found.values[1],
                             .delta2_dps = theta * found.values[1],
                             .measurement_noise_std_dps = found.values[0]},
            .misfit = found.objective};
    if (component != SlowComponent::none) best.slow_std_dps = found.values[2];
    if (component == SlowComponent::gauss_markov) best.correlation_time_s = found.values[3];
  }
  return best;
}

}  // namespace gyrostat::gap
