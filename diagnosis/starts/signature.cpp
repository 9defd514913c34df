#include <gyrostat/diagnosis/starts/signature.hpp>

#include <cmath>

#include <Eigen/QR>

#include <gyrostat/diagnosis/model_fit.hpp>

namespace gyrostat::gap {
namespace {

/// Innovations of a local level in white noise, each stretch from its first value on.
void whiten_walk(const Evidence& evidence, std::vector<double>& values) {
  const auto& arima = evidence.baseline.random_error;
  const auto m = static_cast<double>(evidence.conditions().cluster());
  const double white = std::pow(arima.measurement_noise_std_dps, 2) / m;
  const double walk =
      std::pow((arima.delta1_dps - arima.delta2_dps) / (1.0 - arima.phi), 2) * m + 1e-6 * white;
  const double ratio = walk / white;
  const double gain = 0.5 * (std::sqrt(ratio * ratio + 4.0 * ratio) - ratio);
  for (const auto& span : evidence.conditions().slow_spans(Part::train)) {
    double level = values[span.first];
    for (std::size_t i = span.first; i < span.last; ++i) {
      const double innovation = values[i] - level;
      level += gain * innovation;
      values[i] = innovation;
    }
  }
}

Eigen::VectorXd train_only(const std::vector<double>& values, const std::vector<Span>& spans,
                           std::size_t stride) {
  std::vector<double> kept;
  for (const auto& span : spans)
    for (std::size_t i = span.first; i < span.last; i += stride)
      kept.push_back(is_missing(values[i]) ? 0.0 : values[i]);
  return Eigen::Map<Eigen::VectorXd>(kept.data(), static_cast<Eigen::Index>(kept.size()));
}

Eigen::VectorXd reduce(const Evidence& evidence, Trace trace, std::vector<double> values) {
  const auto& conditions = evidence.conditions();
  if (trace != Trace::slow_rate) {
    Eigen::VectorXd kept = train_only(values, conditions.spans(Part::train), 1);
    kept.array() -= kept.mean();
    return kept;
  }
  whiten_walk(evidence, values);
  Eigen::VectorXd kept = train_only(values, conditions.slow_spans(Part::train), 1);
  const auto& regressors = conditions.drift_regressors();
  Eigen::MatrixXd drift(kept.size(), regressors.cols());
  for (Eigen::Index c = 0; c < regressors.cols(); ++c) {
    std::vector<double> column(regressors.col(c).begin(), regressors.col(c).end());
    whiten_walk(evidence, column);
    drift.col(c) = train_only(column, conditions.slow_spans(Part::train), 1);
  }
  return kept - drift * drift.completeOrthogonalDecomposition().solve(kept);
}

std::vector<double> trace_values(const Evidence& evidence, Trace trace, const Series& series) {
  const auto& conditions = evidence.conditions();
  if (trace == Trace::rate) return series.gyro_dps;
  if (trace == Trace::slow_rate) return conditions.slow_means(series.gyro_dps);
  return series.heading_deg;
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

Rest rest_without(const Evidence& evidence, const Effect& effect) {
  const auto& conditions = evidence.conditions();
  Scenario quiet = quiet_scenario(evidence);
  Series without, with;
  synthesise_rate_under(quiet, conditions.series(), {}, without);
  quiet.effects = {effect};
  synthesise_rate_under(quiet, conditions.series(), {}, with);
  Series rest = evidence.recording;
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest.gyro_dps[i] -= with.gyro_dps[i] - without.gyro_dps[i];
  rest.heading_deg.clear();
  const Scene scene(conditions, rest);
  return fit_rest(conditions, scene);
}

Eigen::MatrixXd signatures(const Evidence& evidence, Trace trace,
                           const std::vector<Effect>& effects) {
  Scenario quiet = quiet_scenario(evidence);
  const auto& conditions = evidence.conditions().series();
  Series without, with;
  synthesise_under(quiet, conditions, {}, without);
  const auto nothing = trace_values(evidence, trace, without);
  Eigen::MatrixXd columns;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    quiet.effects = {effects[k]};
    synthesise_under(quiet, conditions, {}, with);
    auto added = trace_values(evidence, trace, with);
    for (std::size_t i = 0; i < added.size(); ++i)
      added[i] =
          trace == Trace::heading ? wrap_degrees(added[i] - nothing[i]) : added[i] - nothing[i];
    const Eigen::VectorXd column = reduce(evidence, trace, std::move(added));
    columns.conservativeResize(column.size(), static_cast<Eigen::Index>(k) + 1);
    columns.col(static_cast<Eigen::Index>(k)) = column;
  }
  return columns;
}

Eigen::VectorXd trace_of(const Evidence& evidence, Trace trace) {
  if (trace == Trace::rate) return reduce(evidence, trace, evidence.scene.rate_error_dps);
  if (trace == Trace::heading) return reduce(evidence, trace, evidence.scene.heading_error_deg);
  return reduce(evidence, trace, evidence.conditions().slow_means(evidence.scene.rate_error_dps));
}

Match match(const Eigen::MatrixXd& columns, const Eigen::VectorXd& trace) {
  const Eigen::VectorXd amplitudes = columns.completeOrthogonalDecomposition().solve(trace);
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
