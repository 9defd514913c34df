#pragma once

#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// A scenario fitted to the train part of a recording, and the change of its mean readings with the
/// parameters that every fit moves: white noise, random walk and compass noise (logarithms).
struct BaselineFit {
  Scenario scenario;
  Eigen::MatrixXd train_jacobian;
};

/// a T + b T' + c by least squares, from the train part of a scene.
ThermalDrift<double> fit_drift(const Conditions& conditions, const Scene& scene);

/// White noise, random walk, a T + b T' + c and white compass noise, without effects: those under
/// which the train part of the recording is likeliest.
BaselineFit fit_baseline(const Simulator& simulator, const Series& recording);

/// What moves the readings of a fitted scenario without effects.
BaselineFit linearised(const Simulator& simulator, const Scenario& scenario);

}  // namespace gyrostat::gap
