#pragma once

#include <vector>

#include <gyrostat/diagnosis/candidate.hpp>
#include <gyrostat/diagnosis/signature.hpp>
#include <gyrostat/generators/effects/list.hpp>

namespace gyrostat::gap {

/// The value below which `share` of `values` lie; 0 of none.
double quantile(std::vector<double> values, double share);

/// Steps of the rate error from sample to sample of the train part.
std::vector<double> train_steps(const Evidence& e);

/// The baseline's random error and drift with other white noise.
Rest with_white(const Evidence& e, double white_std_dps);

/// The effect beside the random error that the baseline has.
template <class E>
std::vector<Start> with_noise_of(const Evidence& e, const E& effect) {
  return {Start{effect, {e.baseline.random_error, e.baseline.thermal_drift}}};
}

/// A deterministic effect beside the random error of the recording without it.
template <class E>
std::vector<Start> cleaned(const Evidence& e, const E& effect) {
  return {Start{effect, rest_without(e, effect)}};
}

/// First parameters from the recording; an effect without an estimate below starts from its
/// defaults.
template <class E>
std::vector<Start> start(const E& effect, const Evidence& e) {
  return with_noise_of(e, effect);
}

std::vector<Start> start(effects::Quantization, const Evidence& e);
std::vector<Start> start(effects::Outliers, const Evidence& e);
std::vector<Start> start(effects::NoiseBandwidth, const Evidence& e);
std::vector<Start> start(effects::NoiseTemperature, const Evidence& e);
std::vector<Start> start(effects::StaleSamples, const Evidence& e);

std::vector<Start> start(effects::BiasInstability, const Evidence& e);
std::vector<Start> start(effects::GaussMarkov, const Evidence& e);
std::vector<Start> start(effects::Telegraph, const Evidence& e);
std::vector<Start> start(effects::BiasSteps, const Evidence& e);
std::vector<Start> start(effects::Sinusoidal, const Evidence& e);
std::vector<Start> start(effects::Vibration, const Evidence& e);
std::vector<Start> start(effects::RateRamp, const Evidence& e);

std::vector<Start> start(effects::ThermalCurvature, const Evidence& e);
std::vector<Start> start(effects::ThermalHysteresis, const Evidence& e);
std::vector<Start> start(effects::ThermalLag, const Evidence& e);

std::vector<Start> start(effects::ScaleFactor, const Evidence& e);
std::vector<Start> start(effects::ScaleAsymmetry, const Evidence& e);
std::vector<Start> start(effects::SensorBandwidth, const Evidence& e);
std::vector<Start> start(effects::DeadZone, const Evidence& e);
std::vector<Start> start(effects::Saturation, const Evidence& e);
std::vector<Start> start(effects::GSensitivity, const Evidence& e);

std::vector<Start> start(effects::HardIron, const Evidence& e);
std::vector<Start> start(effects::SoftIron, const Evidence& e);
std::vector<Start> start(effects::CompassLag, const Evidence& e);
std::vector<Start> start(effects::MagneticBursts, const Evidence& e);

}  // namespace gyrostat::gap
