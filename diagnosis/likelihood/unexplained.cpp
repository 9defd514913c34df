#include <gyrostat/diagnosis/likelihood/unexplained.hpp>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

constexpr int iterations = 6;
constexpr std::size_t bands = 12;

/// Regressors that have something in common.
struct Group {
  std::string what;
  std::vector<std::vector<double>> columns;
};

/// From -1 at its least to 1 at its largest; empty where it hardly changes.
std::vector<double> scaled(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double half = 0.5 * (*high - *low), middle = 0.5 * (*high + *low);
  if (!(half > 1e-9)) return {};
  std::vector<double> x;
  for (const double v : values) x.push_back((v - middle) / half);
  return x;
}

std::vector<double> mapped(const std::vector<double>& x, double (*f)(double)) {
  std::vector<double> y(x.size());
  std::transform(x.begin(), x.end(), y.begin(), f);
  return y;
}

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

/// What follows x with the given delay, exponentially.
std::vector<double> delayed(const std::vector<double>& x, double steps) {
  std::vector<double> y = x;
  const double share = -std::expm1(-1.0 / steps);
  for (std::size_t k = 1; k < y.size(); ++k) y[k] = y[k - 1] + share * (x[k] - y[k - 1]);
  return y;
}

/// How far x is from a play of the given half width that it drags along: 1 or -1 on its branches
/// (Krasnosel'skii and Pokrovskii, Systems with Hysteresis, 1989, ch. 1).
std::vector<double> in_its_play(const std::vector<double>& x, double half_width) {
  std::vector<double> y(x.size());
  double play = x.front();
  for (std::size_t k = 0; k < x.size(); ++k) {
    play = std::clamp(play, x[k] - half_width, x[k] + half_width);
    y[k] = (x[k] - play) / half_width;
  }
  return y;
}

std::vector<Group> groups_of(const Conditions& conditions) {
  std::vector<Group> groups;
  const double step_s = conditions.slow_interval_s();
  const auto time = scaled(conditions.slow_time_s());
  const double steps = static_cast<double>(conditions.slow_size());
  const auto decay = [&](double share) {
    std::vector<double> y(time.size());
    for (std::size_t k = 0; k < y.size(); ++k)
      y[k] = std::exp(-static_cast<double>(k) / (share * steps));
    return y;
  };
  groups.push_back({"time", {time, mapped(time, square), decay(0.03), decay(0.1)}});
  if (const auto T = scaled(conditions.slow_temperature_C()); !T.empty()) {
    groups.push_back({"temperature", {mapped(T, square), mapped(T, cube)}});
    groups.push_back({"branch of the temperature",
                      {in_its_play(T, 0.05), in_its_play(T, 0.15), in_its_play(T, 0.5)}});
    groups.push_back(
        {"past of the temperature", {delayed(T, 60.0 / step_s), delayed(T, 240.0 / step_s)}});
  }
  const auto& series = conditions.series();
  Group acceleration{"acceleration", {}};
  std::vector<double> squares(conditions.slow_size(), 0.0);
  for (const auto* channel : {&series.acc_x_mps2, &series.acc_y_mps2, &series.acc_z_mps2}) {
    if (channel->empty()) continue;
    auto means = conditions.slow_means(*channel);
    const auto square_means = conditions.slow_means(mapped(*channel, square));
    for (std::size_t k = 0; k < squares.size(); ++k) squares[k] += square_means[k];
    if (auto x = scaled(means); !x.empty()) acceleration.columns.push_back(x);
  }
  if (!acceleration.columns.empty()) {
    if (auto x = scaled(squares); !x.empty()) acceleration.columns.push_back(x);
    groups.push_back(acceleration);
  }
  if (!series.rate_ref_dps.empty())
    if (const auto rate = scaled(conditions.slow_means(series.rate_ref_dps)); !rate.empty())
      groups.push_back(
          {"rate",
           {rate, mapped(rate, [](double x) { return std::abs(x); }), mapped(rate, square)}});
  return groups;
}

/// What is looked for may be in the walk.
Scenario with_little_walk(const Scenario& set) { return with_walk_times(set, 0.1); }

double log_bayes_factor_of(const SetFitter& fitter, const Scenario& set, double without,
                           const Group& group) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(group.columns.front().size()),
                          static_cast<Eigen::Index>(group.columns.size()));
  for (Eigen::Index c = 0; c < columns.cols(); ++c)
    for (Eigen::Index k = 0; k < columns.rows(); ++k) {
      const double value = group.columns[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)];
      columns(k, c) = is_missing(value) ? 0.0 : value;
    }
  const auto beside = fitter.beside(columns);
  return beside.maximise(with_little_walk(set), iterations, Jumping::no).log_likelihood - without;
}

/// Of a slow error that forgets, beside the walk.
double log_bayes_factor_of_memory(const SetFitter& fitter, const Conditions& conditions,
                                  const Scenario& set, double without) {
  const double duration_s = conditions.interval_s() * static_cast<double>(conditions.size());
  const double slow_dps = fitter.slow_deviation_dps();
  double best = -1e300;
  for (double memory_s = 4.0 * conditions.slow_interval_s(); memory_s < duration_s / 6.0;
       memory_s *= 4.0) {
    Scenario start = with_little_walk(set);
    start.effects.push_back(
        with_values("gauss_markov", {{"std_dps", slow_dps}, {"correlation_time_s", memory_s}}));
    best = std::max(best, fitter.maximise(start, iterations, Jumping::no).log_likelihood);
  }
  constexpr double cost_of_two_parameters = 3.0;
  return best - without - cost_of_two_parameters;
}

double p_of_the_spectrum(const SetFitter& fitter, const Conditions& conditions,
                         const Scenario& set) {
  const auto& reduced = fitter.reduced();
  const auto& seen = reduced.periodogram();
  if (seen.empty()) return 1.0;
  const auto density = reduced.grid().shown(
      density_of(law_of(set, conditions.interval_s()), reduced.grid().angles()));
  const std::size_t first = reduced.grid().first_fast_bin(), last = density.size() - 1;
  if (last < first + 4 * bands) return 1.0;
  double sum = 0.0;
  for (std::size_t b = 0; b < bands; ++b) {
    const std::size_t from = first + b * (last - first) / bands;
    const std::size_t to = first + (b + 1) * (last - first) / bands;
    double ratio = 0.0;
    for (std::size_t k = from; k < to; ++k) ratio += seen[k] / density[k];
    const auto bins = static_cast<double>(to - from);
    sum += square(ratio / bins - 1.0) * bins * reduced.degrees();
  }
  return chi_squared_upper_tail(sum, static_cast<double>(bands));
}

}  // namespace

double p_of_the_oddest(const std::vector<Unexplained>& ways) {
  double least = 1.0;
  for (const auto& way : ways) least = std::min(least, way.p_value);
  return ways.empty() ? 1.0 : std::min(1.0, least * static_cast<double>(ways.size()));
}

std::vector<Unexplained> unexplained_by(const Conditions& conditions, const SetFitter& fitter,
                                        const Scenario& set) {
  const double without = fitter.maximise(set, iterations, Jumping::no).log_likelihood;
  const auto groups = groups_of(conditions);
  std::vector<Unexplained> found(groups.size() + 2);
  tbb::parallel_for(std::size_t{0}, groups.size() + 1, [&](std::size_t k) {
    const bool is_memory = k == groups.size();
    const double gain = is_memory ? log_bayes_factor_of_memory(fitter, conditions, set, without)
                                  : log_bayes_factor_of(fitter, set, without, groups[k]);
    found[k] = {is_memory ? "memory" : groups[k].what, std::min(1.0, std::exp(-gain))};
  });
  found.back() = {"spectrum", p_of_the_spectrum(fitter, conditions, set)};
  return found;
}

}  // namespace gyrostat::gap
