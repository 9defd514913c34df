// Which part of the rate error an effect belongs to decides what it is searched beside.

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/generators/effects/list.hpp>

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

/// 29 samples and 31: of the former a filter makes as much.
TEST(EffectBand, OfAProcessGoesByHowLongItLasts) {
  Series series;
  for (int i = 0; i < 2000; ++i) {
    series.t_s.push_back(0.01 * i);
    series.gyro_dps.push_back(i % 7);
  }
  const Conditions conditions(series);
  EXPECT_EQ(band_of(effects::GaussMarkov{0.01, 0.29}, conditions), EffectBand::fast);
  EXPECT_EQ(band_of(effects::GaussMarkov{0.01, 0.31}, conditions), EffectBand::slow);
  EXPECT_EQ(band_of(effects::Telegraph{0.01, 0.05}, conditions), EffectBand::slow);
}

TEST(EffectBand, OfThermalEffectsIsWhatIsFollowedByACurve) {
  EXPECT_EQ(effects_of(EffectBand::thermal),
            (Effects{"g_sensitivity", "rate_ramp", "start_up", "thermal_curvature",
                     "thermal_hysteresis", "thermal_lag", "vibration_rectification"}));
}

}  // namespace
}  // namespace gyrostat::gap::effect_band_test
