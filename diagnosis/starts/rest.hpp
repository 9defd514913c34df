#pragma once

#include <vector>

#include <gyrostat/diagnosis/start.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {

/// The baseline's random error and drift with other white noise.
inline Rest with_white(const Evidence& e, double white_std_dps) {
  Rest rest{e.baseline.random_error, e.baseline.thermal_drift};
  rest.random_error.measurement_noise_std_dps = white_std_dps;
  return rest;
}

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

}  // namespace gyrostat::gap
