#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/gap/scene.hpp>
#include <gyrostat/diagnosis/likelihood/nameless_colour.hpp>
#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>
#include <gyrostat/generators/effects/empirical_compass_noise.hpp>

namespace gyrostat::gap {
namespace {

/// A Gauss-Markov wander beside white noise: none where its variance is 0.
struct Wander {
  double variance = 0.0, time_s = 1.0;
};

/// The likeliest one in cluster means at the train part's points, on a grid, their scale profiled.
Wander wander_of(const Conditions& conditions, const std::vector<double>& means) {
  std::vector<std::size_t> points;
  std::vector<double> known;
  for (const std::size_t k : conditions.train_points())
    if (!is_missing(means[k])) points.push_back(k), known.push_back(means[k]);
  constexpr std::size_t fewest = 100;
  if (points.size() < fewest) return {};
  const Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(known.data(), static_cast<Eigen::Index>(known.size()));
  const auto n = static_cast<double>(known.size() - 1);
  struct Fit {
    double log_likelihood, scale;
  };
  const auto fit = [&](double share, double time_s) -> Fit {
    SlowLaw law{.white = 1.0 - share, .walk = 0.0, .parts = {}, .jumps = {}};
    if (share > 0.0) law.parts.push_back({share, std::exp(-conditions.slow_interval_s() / time_s)});
    const auto terms = slow_terms(law, points, values, Eigen::MatrixXd(values.size(), 0), {});
    double squares = 0.0, logs = 0.0;
    for (const double e : terms.innovations) squares += e * e;
    for (const double v : terms.log_variances) logs += v;
    return {-0.5 * (logs + n * std::log(squares / n)), squares / n};
  };
  const double white = fit(0.0, 1.0).log_likelihood;
  const double longest_s = 0.25 * conditions.slow_interval_s() * static_cast<double>(means.size());
  Wander best;
  double most = clear_gain;
  for (double time_s = 2.0 * conditions.slow_interval_s(); time_s < longest_s; time_s *= 1.6)
    for (const double odds : {0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.0, 6.0, 12.0, 50.0}) {
      const double share = odds / (1.0 + odds);
      const auto f = fit(share, time_s);
      if (f.log_likelihood - white <= most) continue;
      most = f.log_likelihood - white;
      best = {share * f.scale, time_s};
    }
  return best;
}

}  // namespace

std::optional<Nameless> colour_of_the_compass(const Simulator& simulator, const Series& recording,
                                              const Scenario& set) {
  const auto& conditions = simulator.conditions();
  const double white = set.compass.noise_std_deg;
  if (!conditions.has_heading() || !(white > 0.0)) return std::nullopt;
  for (const auto& effect : set.effects)
    if (effect.id() == "magnetic_bursts") return std::nullopt;
  Scenario quiet = set;
  quiet.compass.noise_std_deg = 0.0;
  auto left = Scene(conditions, recording, train_alone).heading_error_deg;
  const Series replica = simulator.replica(quiet, 0);
  const auto repeated = Scene(conditions, replica, train_alone).heading_error_deg;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= repeated[i];
  const auto wander = wander_of(conditions, conditions.slow_means(left));
  std::vector<double> sums(effects::EmpiricalCompassNoise::order + 1, 0.0),
      counts(sums.size(), 0.0);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      for (std::size_t lag = 0; lag < sums.size() && i >= span.first + lag; ++lag) {
        const double product = left[i] * left[i - lag];
        if (is_missing(product)) continue;
        sums[lag] += product;
        counts[lag] += 1.0;
      }
  if (counts.back() < 100.0) return std::nullopt;
  for (std::size_t lag = 0; lag < sums.size(); ++lag) sums[lag] /= counts[lag];
  constexpr double least_left = 0.02;
  const double all_of_it = sums[0];
  for (std::size_t lag = 0; lag < sums.size(); ++lag)
    sums[lag] -= wander.variance *
                 std::exp(-static_cast<double>(lag) * conditions.interval_s() / wander.time_s);
  sums[0] = std::max(sums[0], least_left * all_of_it);
  for (double& sum : sums) sum = std::clamp(sum, -0.95 * sums[0], sums[0]);
  const double noise_deg = std::sqrt(sums[0]);
  for (double& sum : sums) sum /= noise_deg * noise_deg;
  const auto all = autoregression(sums);
  const auto chosen = order_of(all, counts[0]);
  const bool is_coloured = chosen.gain >= clear_gain;
  if (!is_coloured && wander.variance == 0.0) return std::nullopt;
  const std::size_t order = is_coloured ? chosen.order : 0;
  Effect effect = effects::EmpiricalCompassNoise{
      .innovation_std_deg = noise_deg * std::sqrt(is_coloured ? all.errors[order] : 1.0),
      .reflection_1 = 0.0,
      .wander_std_deg = std::sqrt(wander.variance),
      .wander_time_s = wander.time_s};
  for (std::size_t m = 0; m < order; ++m) effect.value(m + 1) = all.reflections[m];
  std::string words = is_coloured
                          ? fmt::format(
                                "a compass noise that is not white (correlation {:.2f} from sample "
                                "to sample)",
                                sums[1])
                          : "";
  if (wander.variance > 0.0)
    words += fmt::format("{}a wander of the compass of {:.2g} deg over {:.2g} s",
                         is_coloured ? " and " : "", std::sqrt(wander.variance), wander.time_s);
  return Nameless{effect, words};
}

}  // namespace gyrostat::gap
