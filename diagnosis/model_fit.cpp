#include <gyrostat/diagnosis/model_fit.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>

namespace gyrostat::gap {
namespace {

/// Replicas from here on are for fitting, those before for judging.
constexpr std::uint32_t judging_replicas = 200;

constexpr double dial_step = 0.1;  ///< of a dial, for a difference quotient

std::vector<Dial> noise_dials(const Conditions& conditions) {
  std::vector<Dial> dials;
  if (conditions.has_heading())
    dials.push_back(
        logarithmic([](Scenario& s) -> double& { return s.compass.noise_std_deg; }, 1e-9, 180.0));
  dials.push_back(logarithmic(
      [](Scenario& s) -> double& { return s.random_error.measurement_noise_std_dps; }, 1e-12, 1e6));
  dials.push_back(size_of_walk(1e-12, 1e6));
  return dials;
}

}  // namespace

ThermalDrift<double> fit_drift(const Conditions& conditions, const Scene& scene) {
  // Ordinary least squares: it keeps the level right whatever an effect does to the weights.
  auto slow = conditions.drift(scene.drift);
  for (std::size_t k = 0; k < slow.size(); ++k) slow[k] += scene.slow_dps[k];
  const Eigen::VectorXd values = conditions.train_values(slow);
  const Eigen::MatrixXd regressors = conditions.train_regressors();
  Eigen::MatrixXd design(values.size(), regressors.cols() > 0 ? 3 : 1);
  design.col(0).setOnes();
  if (regressors.cols() > 0) design.rightCols(2) = regressors.leftCols(2);
  const Eigen::VectorXd drift = least_squares(design, values).solution;
  if (drift.size() == 1) return {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = drift[0]};
  return {.a_dps_per_C = drift[1],
          .b_dps_s_per_C = drift[2],
          .c_dps = drift[0] - drift[1] * conditions.slow_temperature_C().front()};
}

BaselineFit fit_baseline(const Simulator& simulator, const Series& recording) {
  auto scenario = likeliest_baseline(simulator, recording);
  Series rate = recording;
  rate.heading_deg.clear();
  scenario.thermal_drift =
      fit_drift(simulator.conditions(), Scene(simulator.conditions(), rate, train_alone));
  return linearised(simulator, scenario);
}

BaselineFit linearised(const Simulator& simulator, const Scenario& scenario) {
  BaselineFit fit{.scenario = scenario, .train_jacobian = {}};
  const auto dials = noise_dials(simulator.conditions());
  constexpr std::size_t replicas = 6;
  const auto count = static_cast<Eigen::Index>(dials.size());
  const Eigen::VectorXd middle = simulator.mean_train(scenario, judging_replicas, replicas);
  fit.train_jacobian.resize(middle.size(), count);
  for (Eigen::Index d = 0; d < count; ++d) {
    const Scenario there = moved(scenario, dials, dial_step * Eigen::VectorXd::Unit(count, d));
    fit.train_jacobian.col(d) =
        (simulator.mean_train(there, judging_replicas, replicas) - middle) / dial_step;
  }
  return fit;
}

}  // namespace gyrostat::gap
