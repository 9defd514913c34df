// What the likelihood takes for the density of an effect, against what its generator makes.

#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include <gyrostat/analysis/spectra/welch.hpp>
#include <gyrostat/diagnosis/likelihood/arima_law.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/set_fit.hpp>
#include <gyrostat/generators/effects/list.hpp>

namespace gyrostat::gap::noise_law_test {
namespace {

constexpr double rate_hz = 20.0;
constexpr std::size_t length = 256;

class Density : public testing::TestWithParam<Effect> {};

/// Band means of periodograms of 40 recordings of 1200 s. A mean of b bins over s segments has a
/// relative standard error of at most sqrt(1.5 / (b s)), s = 40 x 93: five of them are passed by
/// one band in a million; to that come 2 % for the window's leakage and what aliases.
TEST_P(Density, IsWhatTheGeneratorMakes) {
  Scenario s;
  s.sampling = {1200.0, rate_hz};
  s.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.05};
  s.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  s.effects = {GetParam()};
  constexpr std::uint32_t recordings = 40;
  std::vector<double> mean(length / 2 + 1, 0.0);
  double segments = 0.0;
  for (std::uint32_t trial = 0; trial < recordings; ++trial) {
    Series series;
    synthesise(s, {1, trial}, series);
    const std::span<const double> all(series.gyro_dps);
    const auto spectrum = welch(std::vector{all}, rate_hz, length, length);
    segments += static_cast<double>(spectrum.segments);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += spectrum.density[k] / recordings;
  }
  const auto expected = density_of(law_of(s, 1.0 / rate_hz), Angles(mean.size()));
  for (std::size_t first = 4; first + 8 < mean.size(); first += 8) {
    double seen = 0.0, law = 0.0;
    for (std::size_t k = first; k < first + 8; ++k) seen += mean[k], law += expected[k];
    EXPECT_NEAR(seen / law, 1.0, 5.0 * std::sqrt(1.5 / (8.0 * segments)) + 0.02)
        << GetParam().id() << " from bin " << first;
  }
}

/// A density that takes over what another law has of it is the one that is made anew.
TEST(DensityParts, AreTakenOverOnlyWhereTheyAreTheSame) {
  const Angles angles(length / 2 + 1);
  NoiseLaw law{.interval_s = 1.0 / rate_hz, .white = 0.01};
  law.filter = effects::NoiseBandwidth{.cutoff_hz = 4.0, .poles = 3.0};
  law.averaging = {0.75, 0.125};
  law.wandering = {{.frequency_hz = 3.0}, {.frequency_hz = 5.0}};
  DensityParts parts;
  EXPECT_EQ(density_of(law, angles, parts), density_of(law, angles));
  const auto first = parts;
  const auto differs = [&](const auto& change) {
    auto other = law;
    change(other);
    auto near = first;
    EXPECT_EQ(density_of(other, angles, near), density_of(other, angles));
    EXPECT_NE(density_of(other, angles), density_of(law, angles));
  };
  differs([](NoiseLaw& l) { l.white = 0.02; });
  differs([](NoiseLaw& l) { l.filter->cutoff_hz = 4.1; });
  differs([](NoiseLaw& l) { l.filter.reset(); });
  differs([](NoiseLaw& l) { l.averaging = {0.7, 0.15}; });
  differs([](NoiseLaw& l) { l.wandering[1].wander_hz = 0.1; });
  differs([](NoiseLaw& l) { l.wandering.pop_back(); });
  differs([](NoiseLaw& l) { l.wandering.push_back({.frequency_hz = 7.0}); });
}

/// The walk and the decaying error that an ARIMA(1,1,1) is taken apart into have its spectrum, and
/// make it again.
TEST(ArimaLaw, IsTheSpectrumOfTheModel) {
  for (const auto& e :
       {Arima111<double>{0.8, 0.003, 0.0028, 0.01}, Arima111<double>{0.5, 0.004, 0.002, 0.02},
        Arima111<double>{0.8, 0.008, 0.002, 0.02}, Arima111<double>{0.3, 0.002, -0.001, 0.05}}) {
    const auto law = ArimaLaw::of(e);
    for (double angle = 0.05; angle < 3.14; angle += 0.3) {
      const auto z = std::polar(1.0, -angle);
      const double whole = std::norm(e.delta1_dps - e.delta2_dps * z) /
                           (std::norm(1.0 - e.phi * z) * std::norm(1.0 - z));
      const double parts = law.walk_dps * law.walk_dps / std::norm(1.0 - z) +
                           law.memory / std::norm(1.0 - e.phi * z);
      EXPECT_NEAR(parts / whole, 1.0, 1e-12) << e.delta1_dps << " at " << angle;
    }
    Arima111<double> again;
    law.put(again);
    EXPECT_NEAR(again.delta1_dps, e.delta1_dps, 1e-15);
    EXPECT_NEAR(again.delta2_dps, e.delta2_dps, 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(
    NoiseLaw, Density,
    testing::Values(
        Effect(effects::NoiseBandwidth{.cutoff_hz = 3.0, .poles = 1.0}),
        Effect(effects::NoiseBandwidth{.cutoff_hz = 4.0, .poles = 2.0}),
        Effect(effects::NoiseBandwidth{.cutoff_hz = 6.0, .poles = 2.0, .maximally_flat = 1.0}),
        Effect(effects::NoiseBandwidth{
            .cutoff_hz = 7.0, .poles = 2.0, .maximally_flat = 1.0, .continuous = 1.0}),
        Effect(effects::NoiseBandwidth{.cutoff_hz = 4.0, .poles = 2.0, .continuous = 1.0}),
        Effect(effects::NoiseBandwidth{
            .cutoff_hz = 3.0, .poles = 2.0, .maximally_flat = 1.0, .after_dps = 0.02}),
        Effect(effects::NoiseAveraging{.length = 1.4}),
        Effect(effects::NoiseAveraging{.length = 1.7, .stages = 2.0}),
        Effect(effects::AngleQuantization{.coefficient_deg = 0.003}),
        Effect(effects::GaussMarkov{.std_dps = 0.05, .correlation_time_s = 1.0}),
        Effect(effects::GaussMarkov{.std_dps = 0.05, .correlation_time_s = 1.0, .order = 2.0}),
        Effect(effects::BiasInstability{.coefficient_dps = 0.03}),
        Effect(effects::Telegraph{.amplitude_dps = 0.05, .mean_dwell_s = 1.5}),
        Effect(effects::Vibration{.std_dps = 0.05, .centre_hz = 4.0, .bandwidth_hz = 0.8}),
        Effect(effects::WanderingLine{.amplitude_dps = 0.07,
                                      .frequency_hz = 4.0,
                                      .wander_hz = 0.8,
                                      .correlation_time_s = 0.1}),
        Effect(effects::WanderingLine{.amplitude_dps = 0.07,
                                      .frequency_hz = 4.0,
                                      .wander_hz = 0.5,
                                      .correlation_time_s = 1.0}),
        Effect(effects::Quantization{.lsb_dps = 0.05})));

}  // namespace
}  // namespace gyrostat::gap::noise_law_test
