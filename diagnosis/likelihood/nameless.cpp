#include <gyrostat/diagnosis/likelihood/nameless.hpp>

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/diagnosis/gap/scene.hpp>
#include <gyrostat/diagnosis/likelihood/autoregression.hpp>
#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>
#include <gyrostat/generators/effects/empirical_compass_noise.hpp>
#include <gyrostat/generators/effects/empirical_noise.hpp>

namespace gyrostat::gap {
namespace {

constexpr double clear_gain = 10.0;  ///< nats beyond what its parameters win by chance

struct Chosen {
  std::size_t order;
  double gain;  ///< nats against white noise of variance 1, less one a parameter
};
/// From so many independent values.
Chosen order_of(const Autoregression& all, double values) {
  Chosen best{0, -1e300};
  for (std::size_t p = 0; p < all.errors.size(); ++p) {
    const double gain =
        0.5 * values * (all.errors[0] - 1.0 - std::log(all.errors[p])) - static_cast<double>(p + 1);
    if (gain > best.gain) best = {p, gain};
  }
  return best;
}

/// Where most of a change of the spectrum lies: the middle two thirds of what was added, or of what
/// was taken away.
std::string change_in_words(const std::vector<double>& ratio, const std::vector<double>& white,
                            double resolution_hz) {
  double added = 0.0, taken = 0.0;
  for (std::size_t k = 1; k < ratio.size(); ++k)
    (ratio[k] > 1.0 ? added : taken) += std::abs(ratio[k] - 1.0) * white[k];
  const bool adds = added >= taken;
  const double all = adds ? added : taken;
  double sum = 0.0, from_hz = 0.0, to_hz = 0.0;
  for (std::size_t k = 1; k < ratio.size(); ++k) {
    if ((ratio[k] > 1.0) != adds) continue;
    const double before = sum;
    sum += std::abs(ratio[k] - 1.0) * white[k];
    const double at = resolution_hz * static_cast<double>(k);
    if (before < all / 6.0 && sum >= all / 6.0) from_hz = at;
    if (before < all * 5.0 / 6.0 && sum >= all * 5.0 / 6.0) to_hz = at;
  }
  return fmt::format("{} of the noise without a name, mostly from {:.3g} to {:.3g} Hz",
                     adds ? "a surplus" : "a lack", from_hz, to_hz);
}

std::optional<Nameless> colour_of_the_noise(const Conditions& conditions, const SetFitter& fitter,
                                            const Scenario& set) {
  const auto& reduced = fitter.reduced();
  const auto& seen = reduced.periodogram();
  if (seen.size() < 16) return std::nullopt;
  const auto law = law_of(set, conditions.interval_s());
  NoiseLaw white{.interval_s = law.interval_s, .white = law.white};
  white.filter = law.filter;
  white.averaging = law.averaging;
  const auto density_of_law = [&](const NoiseLaw& of) {
    return reduced.grid().shown(density_of(of, reduced.grid().angles()));
  };
  const auto whole = density_of_law(law), plain = density_of_law(white);
  constexpr double least = 0.02;  // what is taken away leaves something
  const std::size_t first = reduced.grid().first_fast_bin();
  std::vector<double> ratio(seen.size());
  for (std::size_t k = first; k < seen.size(); ++k)
    ratio[k] = std::max(least, 1.0 + (seen[k] - whole[k]) / plain[k]);
  // Below, the noise is not seen: slow errors are.
  constexpr std::size_t width = 4;
  const auto lowest = ratio.begin() + static_cast<std::ptrdiff_t>(first);
  std::fill(ratio.begin(), lowest, std::accumulate(lowest, lowest + width, 0.0) / width);
  // Half a spectrum has its ends once.
  std::vector<double> covariance(effects::EmpiricalNoise::order + 1, 0.0);
  const auto last = ratio.size() - 1;
  for (std::size_t k = 0; k <= last; ++k)
    for (std::size_t lag = 0; lag < covariance.size(); ++lag)
      covariance[lag] += (k == 0 || k == last ? 0.5 : 1.0) * ratio[k] *
                         std::cos(static_cast<double>(lag) * reduced.grid().angles().values[k]) /
                         static_cast<double>(last);
  const auto all = autoregression(covariance);
  const auto chosen = order_of(all, 2.0 * reduced.degrees() * static_cast<double>(last - first));
  if (chosen.gain < clear_gain) return std::nullopt;
  Effect effect =
      effects::EmpiricalNoise{.gain = std::sqrt(all.errors[chosen.order]), .reflection_1 = 0.0};
  for (std::size_t m = 0; m < chosen.order; ++m) effect.value(m + 1) = all.reflections[m];
  return Nameless{effect, change_in_words(ratio, plain, reduced.grid().resolution_hz())};
}

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

/// A wander, and what colours the rest.
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

}  // namespace

std::vector<Nameless> nameless_parts(const Simulator& simulator, const Series& recording,
                                     const SetFitter& fitter, const Scenario& fitted,
                                     const Scenario& set) {
  std::vector<Nameless> parts;
  if (auto noise = colour_of_the_noise(simulator.conditions(), fitter, fitted))
    parts.push_back(*noise);
  if (auto compass = colour_of_the_compass(simulator, recording, set)) parts.push_back(*compass);
  return parts;
}

Scenario with_nameless(Scenario set, const std::vector<Nameless>& parts) {
  for (const auto& part : parts) {
    // The colour is that of all the noise there is.
    if (part.effect.stage() == Stage::compass) set.compass.noise_std_deg = 0.0;
    set.effects.push_back(part.effect);
  }
  return set;
}

}  // namespace gyrostat::gap
