#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>

#include <cmath>

#include <gyrostat/diagnosis/likelihood/walking_level.hpp>

namespace gyrostat::gap {
namespace {

/// The train part, without its level or its mean; what is missing is as if it were that.
Eigen::VectorXd reduce(const Evidence& evidence, Trace trace, const std::vector<double>& values) {
  std::vector<double> kept;
  for (const auto& span : evidence.conditions().spans(Part::train)) {
    WalkingLevel level(evidence.level_gain);
    for (std::size_t i = span.first; i < span.last; ++i)
      if (is_missing(values[i]))
        kept.push_back(0.0);
      else
        kept.push_back(trace == Trace::rate ? level.innovation(values[i]) : values[i]);
  }
  Eigen::VectorXd reduced =
      Eigen::Map<Eigen::VectorXd>(kept.data(), static_cast<Eigen::Index>(kept.size()));
  if (trace == Trace::heading) reduced.array() -= reduced.mean();
  return reduced;
}

/// What a scenario without noise makes of the trace.
std::vector<double> trace_of(const Scenario& quiet, Trace trace, const Series& conditions) {
  Series series;
  if (trace == Trace::heading) {
    synthesise_heading_under(quiet, conditions, {}, series);
    return std::move(series.heading_deg);
  }
  synthesise_rate_under(quiet, conditions, {}, series);
  return std::move(series.gyro_dps);
}

/// The baseline's drift-free, noise-free simulator.
Scenario quiet_scenario(const Evidence& evidence) {
  Scenario quiet;
  quiet.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  quiet.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  quiet.compass.noise_std_deg = 0.0;
  quiet.compass.initial_heading_deg = evidence.baseline.compass.initial_heading_deg;
  return quiet;
}

}  // namespace

Eigen::MatrixXd signatures(const Evidence& evidence, Trace trace,
                           const std::vector<Effect>& effects) {
  Scenario quiet = quiet_scenario(evidence);
  const auto& conditions = evidence.conditions().series();
  if (trace == Trace::rate) quiet.effects = evidence.baseline.effects;
  const auto nothing = trace_of(quiet, trace, conditions);
  Eigen::MatrixXd columns;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    Scenario with = quiet;
    with.effects.push_back(effects[k]);
    auto added = trace_of(with, trace, conditions);
    for (std::size_t i = 0; i < added.size(); ++i)
      added[i] =
          trace == Trace::heading ? wrap_degrees(added[i] - nothing[i]) : added[i] - nothing[i];
    const Eigen::VectorXd column = reduce(evidence, trace, added);
    columns.conservativeResize(column.size(), static_cast<Eigen::Index>(k) + 1);
    columns.col(static_cast<Eigen::Index>(k)) = column;
  }
  return columns;
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
  int best = 0;
  double least = cost(low);
  for (int k = 1; k < points; ++k)
    if (const double c = cost(low * std::exp(step * k)); c < least) {
      least = c;
      best = k;
    }
  constexpr double golden = 0.6180339887498949;
  double a = std::log(low) + step * std::max(best - 1, 0);
  double b = std::log(low) + step * std::min(best + 1, points - 1);
  double c = b - golden * (b - a), d = a + golden * (b - a);
  double at_c = cost(std::exp(c)), at_d = cost(std::exp(d));
  for (int k = 0; k < 14; ++k) {
    if (at_c < at_d) {
      b = d, d = c, at_d = at_c, c = b - golden * (b - a), at_c = cost(std::exp(c));
    } else {
      a = c, c = d, at_c = at_d, d = a + golden * (b - a), at_d = cost(std::exp(d));
    }
  }
  return std::exp(0.5 * (a + b));
}

}  // namespace gyrostat::gap
