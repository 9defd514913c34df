#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/experiments/findings/models/sensor_model.hpp>

namespace gyrostat {

/// By how much white noise and a walk must be made larger so that they are nowhere below what they
/// stand for, at any averaging time up to the one asked for.
struct Cover {
  std::string because;  ///< the effect, or what was measured
  double factor_of_N = 1.0;
  double factor_of_K = 1.0;  ///< instead of N; 0: no walk to enlarge, or it would be no help
  double up_to_s = 0.0;      ///< the longest averaging time at which N alone is too small by 5 %
};

/// Of what the Allan variance N² / tau + K² tau / 3 of a model must cover: an effect's own Allan
/// variance beside it (by its law, exact), or, of a recording, the measured one. With sigma²(tau)
/// the variance in all, N is multiplied by the root of the largest tau (sigma² - K² tau / 3) / N²,
/// over all tau from a sample's up to `averaging_s`; or K by that of 3 (sigma² - N² / tau) / (tau
/// K²). One entry for each of the effects `left_out` that has an Allan variance, and one for all of
/// them together, if there are several; nothing where nothing need be larger.
std::vector<Cover> covers(const SensorModel& model, const std::vector<std::string>& left_out,
                          double averaging_s);

}  // namespace gyrostat
