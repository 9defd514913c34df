// Which part of the rate error an effect belongs to decides what it is searched beside.

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap::effect_band_test {
namespace {

std::vector<std::string> effects_of(EffectBand band) {
  std::vector<std::string> all;
  for (const auto& cause : cause_types())
    if (cause.effect().stage() != Stage::compass && band_of(cause.id) == band)
      all.emplace_back(cause.id);
  std::sort(all.begin(), all.end());
  return all;
}

using Effects = std::vector<std::string>;

TEST(EffectBand, OfFastEffectsIsWhereverTheyAct) {
  EXPECT_EQ(effects_of(EffectBand::fast),
            (Effects{"angle_quantization", "noise_averaging", "noise_bandwidth",
                     "noise_temperature", "outliers", "quantization", "sinusoidal", "stale_samples",
                     "vibration", "vibration_bursts", "wandering_line"}));
}

TEST(EffectBand, OfSlowEffectsIsNoiseThatIsRemembered) {
  EXPECT_EQ(effects_of(EffectBand::slow),
            (Effects{"bias_instability", "bias_steps", "gauss_markov", "telegraph"}));
}

TEST(EffectBand, OfThermalEffectsIsWhatIsFollowedByACurve) {
  EXPECT_EQ(effects_of(EffectBand::thermal),
            (Effects{"g_sensitivity", "rate_ramp", "start_up", "thermal_curvature",
                     "thermal_hysteresis", "thermal_lag", "vibration_rectification"}));
}

}  // namespace
}  // namespace gyrostat::gap::effect_band_test
