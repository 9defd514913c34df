#include <gyrostat/diagnosis/starts/signature.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/likelihood/walking_level.hpp>

namespace gyrostat::gap {
namespace {

/// The train part, without its level or its mean; what is missing is as if it were that.
Eigen::VectorXd reduce(const Evidence& evidence, Trace trace, const std::vector<double>& values) {
  std::vector<double> kept;
  for (const auto& span : evidence.conditions().spans(Part::train)) {
    WalkingLevel level(evidence.level_gain);
    for (std::size_t i = span.first; i < span.last; ++i)
      if (is_missing(values[i]) ||
          (trace == Trace::rate && !evidence.hidden.empty() && evidence.hidden[i] != 0))
        kept.push_back(0.0);
      else
        kept.push_back(trace == Trace::rate ? level.innovation(values[i]) : values[i]);
  }
  Eigen::VectorXd reduced =
      Eigen::Map<Eigen::VectorXd>(kept.data(), static_cast<Eigen::Index>(kept.size()));
  if (trace == Trace::heading) reduced.array() -= reduced.mean();
  return reduced;
}

/// The compass without noise.
std::vector<double> heading_of(const Evidence& evidence, const std::vector<Effect>& effects) {
  Scenario quiet;
  quiet.effects = effects;
  quiet.compass.noise_std_deg = 0.0;
  quiet.compass.initial_heading_deg = evidence.baseline.compass.initial_heading_deg;
  Series series;
  synthesise_heading_under(quiet, evidence.conditions().series(), {}, series);
  return std::move(series.heading_deg);
}

}  // namespace

void take_undisturbed(Evidence& evidence, Trace trace) {
  if (trace == Trace::rate)
    evidence.rate_dps = evidence.simulator.response().of(evidence.baseline.effects);
  else
    evidence.heading_deg = heading_of(evidence, {});
}

Eigen::MatrixXd signatures(const Evidence& evidence, Trace trace,
                           const std::vector<Effect>& effects) {
  std::vector<std::vector<Effect>> sets;
  for (const auto& effect : effects) sets.push_back({effect});
  return signatures_of_sets(evidence, trace, sets);
}

Eigen::MatrixXd signatures_of_sets(const Evidence& evidence, Trace trace,
                                   const std::vector<std::vector<Effect>>& sets) {
  const bool of_rate = trace == Trace::rate;
  const auto made_by = [&](const std::vector<Effect>& all) {
    return of_rate ? evidence.simulator.response().of(all) : heading_of(evidence, all);
  };
  const auto& nothing = of_rate ? evidence.rate_dps : evidence.heading_deg;
  Eigen::MatrixXd columns;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    auto beside = of_rate ? evidence.baseline.effects : std::vector<Effect>{};
    beside.insert(beside.end(), sets[k].begin(), sets[k].end());
    auto added = made_by(beside);
    for (std::size_t i = 0; i < added.size(); ++i)
      added[i] = of_rate ? added[i] - nothing[i] : wrap_degrees(added[i] - nothing[i]);
    const Eigen::VectorXd column = reduce(evidence, trace, added);
    columns.conservativeResize(column.size(), static_cast<Eigen::Index>(k) + 1);
    columns.col(static_cast<Eigen::Index>(k)) = column;
  }
  return columns;
}

std::vector<double> left_by_each(const Evidence& evidence, Trace trace,
                                 const std::vector<Effect>& effects) {
  const auto seen = trace_of(evidence, trace);
  std::vector<double> left;
  for (const auto& effect : effects)
    left.push_back((seen - signatures(evidence, trace, {effect}).col(0)).squaredNorm());
  return left;
}

Eigen::VectorXd trace_of(const Evidence& e, Trace trace) {
  return reduce(e, trace,
                trace == Trace::rate ? e.scene.rate_error_dps : e.scene.heading_error_deg);
}

double level_gain_of(const Conditions& conditions, const std::vector<double>& rate_error_dps) {
  double best = 0.0, most = -1e300;
  for (const double gain : {0.0, 1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3}) {
    double squares = 1e-300, count = 0.0, log_known = 0.0;
    for (const auto& span : conditions.spans(Part::train)) {
      WalkingLevel level(gain);
      for (std::size_t i = span.first; i < span.last; ++i) {
        if (is_missing(rate_error_dps[i])) continue;
        const double innovation = level.innovation(rate_error_dps[i]);
        squares += innovation * innovation;
        count += 1.0;
      }
      log_known += level.log_known();
    }
    const double likelihood = 0.5 * log_known - 0.5 * count * std::log(squares);
    if (likelihood > most) most = likelihood, best = gain;
  }
  return best;
}

Match match(const Eigen::MatrixXd& columns, const Eigen::VectorXd& trace) {
  const Eigen::VectorXd amplitudes = shortest_least_squares(columns, trace);
  return {amplitudes, (trace - columns * amplitudes).squaredNorm() / trace.squaredNorm()};
}

double best_of(double low, double high, const std::function<double(double)>& cost) {
  constexpr int points = 12;
  const double step = std::log(high / low) / (points - 1);
  std::array<double, points> costs;
  tbb::parallel_for(0, points, [&](int k) {
    costs[static_cast<std::size_t>(k)] = cost(low * std::exp(step * k));
  });
  const auto best = static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  constexpr double golden = 0.6180339887498949;
  double a = std::log(low) + step * std::max(best - 1, 0);
  double b = std::log(low) + step * std::min(best + 1, points - 1);
  double c = b - golden * (b - a), d = a + golden * (b - a);
  double at_c = 0.0, at_d = 0.0;
  tbb::parallel_invoke([&] { at_c = cost(std::exp(c)); }, [&] { at_d = cost(std::exp(d)); });
  constexpr int narrower = 9;  // to a 40th of two steps, which a fit goes on from
  for (int k = 0; k < narrower; ++k) {
    if (at_c < at_d) {
      b = d, d = c, at_d = at_c, c = b - golden * (b - a), at_c = cost(std::exp(c));
    } else {
      a = c, c = d, at_c = at_d, d = a + golden * (b - a), at_d = cost(std::exp(d));
    }
  }
  return std::exp(0.5 * (a + b));
}

}  // namespace gyrostat::gap
