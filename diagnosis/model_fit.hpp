#pragma once

#include <gyrostat/diagnosis/simulator.hpp>
#include <gyrostat/diagnosis/start.hpp>

namespace gyrostat::gap {

/// Replicas from here on are for fitting, those before for judging.
inline constexpr std::uint32_t judging_replicas = 200;

/// A scenario fitted to the train part of a recording, and the change of its mean readings with the
/// parameters that every fit moves: white noise, random walk and compass noise (logarithms).
struct BaselineFit {
  Scenario scenario;
  Eigen::MatrixXd train_jacobian;
};

/// Random error by its Allan variances, and a T + b T' + c by least squares, from the train part.
Rest fit_rest(const Conditions& conditions, const Scene& scene);

/// White noise + ARIMA(1,1,1) + a T + b T' + c and white compass noise.
BaselineFit fit_baseline(const Simulator& simulator, const Scene& scene, const Series& recording);

/// Moves the scenario's noise and the free parameters of its effects until its mean simulated
/// readings lie nearest the recording's, robustly: Gauss-Newton on `replicas` common random numbers
/// (simulated minimum distance; Duffie & Singleton, Econometrica 61, 1993). `readings` is the train
/// part's.
Scenario refine(const Simulator& simulator, Scenario scenario, const Eigen::VectorXd& readings,
                const Eigen::VectorXd& spread, int iterations, std::size_t replicas);

}  // namespace gyrostat::gap
