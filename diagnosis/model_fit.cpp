#include <gyrostat/diagnosis/model_fit.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/gap/allan_components.hpp>

namespace gyrostat::gap {
namespace {

/// A parameter of a scenario on the scale that a fit moves it on.
struct Dial {
  std::function<double(const Scenario&)> get;
  std::function<void(Scenario&, double)> set;
  double step;      ///< for a difference quotient
  double furthest;  ///< in one iteration
};

Dial logarithmic(const std::function<double&(Scenario&)>& value, double low, double high) {
  return {[=](const Scenario& s) {
            Scenario copy = s;
            return std::log(std::max(value(copy), 1e-300));
          },
          [=](Scenario& s, double x) { value(s) = std::clamp(std::exp(x), low, high); }, 0.1, 0.8};
}

/// Which noise a fit moves: that of the channel its effects are on.
enum class Noises { all, rate, heading };

Noises noises_of(const Scenario& scenario) {
  bool rate = false, heading = false;
  for (const auto& any : scenario.effects) (any.stage() == Stage::compass ? heading : rate) = true;
  return rate == heading ? Noises::all : rate ? Noises::rate : Noises::heading;
}

std::vector<Dial> noise_dials(const Conditions& conditions, Noises noises) {
  std::vector<Dial> dials;
  if (conditions.has_heading() && noises != Noises::rate)
    dials.push_back(
        logarithmic([](Scenario& s) -> double& { return s.compass.noise_std_deg; }, 1e-9, 180.0));
  if (noises == Noises::heading) return dials;
  dials.push_back(logarithmic(
      [](Scenario& s) -> double& { return s.random_error.measurement_noise_std_dps; }, 1e-12, 1e6));
  Dial walk =
      logarithmic([](Scenario& s) -> double& { return s.random_error.delta1_dps; }, 1e-12, 1e6);
  const auto set_delta1 = walk.set;
  walk.set = [set_delta1](Scenario& s, double x) {
    const double theta = s.random_error.delta2_dps / s.random_error.delta1_dps;
    set_delta1(s, x);
    s.random_error.delta2_dps = theta * s.random_error.delta1_dps;
  };
  dials.push_back(walk);
  return dials;
}

void add_effect_dials(const Scenario& scenario, std::vector<Dial>& dials) {
  for (std::size_t k = 0; k < scenario.effects.size(); ++k) {
    const auto& effect = scenario.effects[k];
    const auto& cause = cause_types().named(effect.id(), "effects");
    if (cause.is_deterministic()) continue;
    const auto& free = cause.free_parameters;
    for (std::size_t f = 0; f < effect.fields().size(); ++f) {
      const auto& field = effect.fields()[f];
      if (std::find(free.begin(), free.end(), field.name) == free.end()) continue;
      const auto value = [k, f](Scenario& s) -> double& { return s.effects[k].value(f); };
      const double start = effect.value(f);
      if (field.range.from >= 0.0 && start > 0.0) {
        dials.push_back(logarithmic(value, std::max(field.range.from, 1e-12), field.range.to));
      } else {
        const double unit = std::max(std::abs(start), 1e-12);
        dials.push_back({[=](const Scenario& s) {
                           Scenario copy = s;
                           return value(copy) / unit;
                         },
                         [=](Scenario& s, double x) { value(s) = unit * x; }, 0.1, 1.0});
      }
    }
  }
}

Scenario moved(Scenario scenario, const std::vector<Dial>& dials, const Eigen::VectorXd& by) {
  std::vector<double> to;
  for (std::size_t d = 0; d < dials.size(); ++d)
    to.push_back(dials[d].get(scenario) + by[static_cast<Eigen::Index>(d)]);
  for (std::size_t d = 0; d < dials.size(); ++d) dials[d].set(scenario, to[d]);
  return scenario;
}

double compass_centre(const Conditions& conditions, const Series& recording) {
  double sine = 0.0, cosine = 0.0;
  constexpr double rad = std::numbers::pi / 180.0;
  const auto& turned = conditions.turned_deg();
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; i += 7) {
      const double error = recording.heading_deg[i] - (turned.empty() ? 0.0 : turned[i]);
      if (is_missing(error)) continue;
      sine += std::sin(error * rad);
      cosine += std::cos(error * rad);
    }
  return std::atan2(sine, cosine) / rad;
}

double compass_noise(const Conditions& conditions, const Scene& scene) {
  std::vector<double> steps;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      if (const double d = scene.heading_error_deg[i] - scene.heading_error_deg[i - 1];
          !is_missing(d))
        steps.push_back(std::abs(d));
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle / 0.6744897501960817 / std::numbers::sqrt2;
}

}  // namespace

Scenario refine(const Simulator& simulator, Scenario scenario, const Eigen::VectorXd& readings,
                const Eigen::VectorXd& spread, int iterations, std::size_t replicas) {
  auto dials = noise_dials(simulator.conditions(), noises_of(scenario));
  add_effect_dials(scenario, dials);
  const auto count = static_cast<Eigen::Index>(dials.size());
  const auto off = [&](const Scenario& s) -> Eigen::VectorXd {
    return (readings - simulator.mean_train(s, judging_replicas, replicas)).cwiseQuotient(spread);
  };
  const auto cost_of = [](const Eigen::VectorXd& z) {
    return (z.array().square() / 4.0).log1p().sum();
  };
  Eigen::VectorXd z = off(scenario);
  double cost = cost_of(z);
  double damping = 1e-2;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Eigen::MatrixXd slope(z.size(), count);
    for (Eigen::Index d = 0; d < count; ++d) {
      const double step = dials[static_cast<std::size_t>(d)].step;
      slope.col(d) =
          (off(moved(scenario, dials, step * Eigen::VectorXd::Unit(count, d))) - z) / -step;
    }
    const Eigen::VectorXd weights = (1.0 + z.array().square() / 4.0).inverse();
    const Eigen::MatrixXd normal = slope.transpose() * weights.asDiagonal() * slope;
    const Eigen::VectorXd gradient = slope.transpose() * weights.asDiagonal() * z;
    bool better = false;
    for (int attempt = 0; attempt < 2 && !better; ++attempt) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() += damping * normal.diagonal() + Eigen::VectorXd::Constant(count, 1e-6);
      Eigen::VectorXd by = damped.ldlt().solve(gradient);
      for (Eigen::Index d = 0; d < count; ++d)
        by[d] = std::clamp(by[d], -dials[static_cast<std::size_t>(d)].furthest,
                           dials[static_cast<std::size_t>(d)].furthest);
      const Scenario trial = moved(scenario, dials, by);
      const Eigen::VectorXd trial_z = off(trial);
      if (const double trial_cost = cost_of(trial_z); trial_cost < cost) {
        better = true;
        const bool settled = cost - trial_cost < 0.5;
        scenario = trial;
        z = trial_z;
        cost = trial_cost;
        damping *= 0.2;
        if (settled) return scenario;
      } else {
        damping = std::max(10.0 * damping, 1.0);
      }
    }
    if (!better) break;
  }
  return scenario;
}

Rest fit_rest(const Conditions& conditions, const Scene& scene) {
  // Ordinary least squares: it keeps the level right whatever an effect does to the weights.
  auto slow = conditions.drift(scene.drift);
  for (std::size_t k = 0; k < slow.size(); ++k) slow[k] += scene.slow_dps[k];
  const Eigen::VectorXd values = conditions.train_values(slow);
  const Eigen::MatrixXd regressors = conditions.train_regressors();
  Eigen::MatrixXd design(values.size(), regressors.cols() > 0 ? 3 : 1);
  design.col(0).setOnes();
  if (regressors.cols() > 0) design.rightCols(2) = regressors.leftCols(2);
  const Eigen::VectorXd drift = design.colPivHouseholderQr().solve(values);
  Rest rest{
      .random_error = fit_allan_components(conditions, scene, SlowComponent::none).random_error,
      .thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = drift[0]}};
  if (drift.size() > 1)
    rest.thermal_drift = {.a_dps_per_C = drift[1],
                          .b_dps_s_per_C = drift[2],
                          .c_dps = drift[0] - drift[1] * conditions.slow_temperature_C().front()};
  return rest;
}

BaselineFit fit_baseline(const Simulator& simulator, const Scene& scene, const Series& recording) {
  const auto& conditions = simulator.conditions();
  BaselineFit fit;
  auto& s = fit.scenario;
  s.sampling.duration_s = conditions.interval_s() * static_cast<double>(conditions.size());
  s.sampling.rate_hz = conditions.rate_hz();
  const auto rest = fit_rest(conditions, scene);
  s.random_error = rest.random_error;
  s.thermal_drift = rest.thermal_drift;
  s.compass.noise_std_deg = 0.0;
  if (conditions.has_heading()) {
    s.compass.noise_std_deg = compass_noise(conditions, scene);
    s.compass.initial_heading_deg = compass_centre(conditions, recording);
  }

  const auto dials = noise_dials(conditions, Noises::all);
  constexpr std::size_t replicas = 6;
  const auto count = static_cast<Eigen::Index>(dials.size());
  const Eigen::VectorXd middle = simulator.mean_train(s, judging_replicas, replicas);
  fit.train_jacobian.resize(middle.size(), count);
  for (Eigen::Index d = 0; d < count; ++d) {
    const double step = dials[static_cast<std::size_t>(d)].step;
    const Scenario there = moved(s, dials, step * Eigen::VectorXd::Unit(count, d));
    fit.train_jacobian.col(d) =
        (simulator.mean_train(there, judging_replicas, replicas) - middle) / step;
  }
  return fit;
}

}  // namespace gyrostat::gap
