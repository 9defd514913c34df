// Noise that is not white, whose truth is known: R is where it belongs.

#include <gyrostat/analysis/fits/random_error.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {
namespace {

using testing::HasSubstr;

constexpr double white_dps = 0.1, walk_dps = 5e-4;

/// Five minutes of white noise and a random walk at 100 Hz, with one effect more.
std::vector<double> recorded(const std::string& effect,
                             const std::vector<std::pair<std::string, double>>& values,
                             std::uint32_t trial = 0) {
  Scenario s;
  s.sampling = {300.0, 100.0};
  s.random_error = {.phi = 0.0,
                    .delta1_dps = walk_dps,
                    .delta2_dps = 0.0,
                    .measurement_noise_std_dps = white_dps};
  s.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.1};
  if (!effect.empty()) {
    Effect any(effect_types().named(effect, "test"));
    for (std::size_t f = 0; f < any.fields().size(); ++f)
      for (const auto& [name, value] : values)
        if (any.fields()[f].name == name) any.value(f) = value;
    s.effects.push_back(any);
  }
  Series series;
  synthesise(s, {.seed = 20250701, .trial = trial}, series);
  return series.gyro_dps;
}

struct Coloured {
  const char* effect;
  std::vector<std::pair<std::string, double>> values;
  double white_dps;  ///< of the same density at low frequencies
};

std::vector<Coloured> coloured() {
  return {{"noise_bandwidth", {{"cutoff_hz", 20.0}, {"poles", 1.0}}, white_dps},
          {"noise_bandwidth", {{"cutoff_hz", 10.0}, {"poles", 2.0}}, white_dps},
          {"noise_bandwidth", {{"cutoff_hz", 5.0}, {"poles", 2.0}}, white_dps},
          {"noise_averaging", {{"length", 2.0}}, white_dps},
          {"vibration", {{"std_dps", 0.07}, {"centre_hz", 21.0}, {"bandwidth_hz", 1.0}}, white_dps},
          {"quantization", {{"lsb_dps", 0.2}}, std::hypot(white_dps, 0.2 / std::sqrt(12.0))}};
}

TEST(RandomError, NoiseThatIsNotWhiteIsInR) {
  for (const auto method : {FitMethod::likelihood, FitMethod::moments})
    for (const auto& c : coloured()) {
      SCOPED_TRACE(testing::Message() << c.effect << ' ' << c.values.front().second << ", method "
                                      << static_cast<int>(method));
      const auto fit = fit_random_error(recorded(c.effect, c.values), method);
      EXPECT_TRUE(fit.converged) << fit.message;
      EXPECT_NEAR(fit.parameters.measurement_noise_std_dps, c.white_dps, 0.1 * c.white_dps);
      EXPECT_LT(fit.parameters.delta1_dps, 0.2 * white_dps);
      if (fit.cluster == 1) continue;
      EXPECT_EQ(fit.parameters.phi, 0.0);
      EXPECT_EQ(fit.parameters.delta2_dps, 0.0);
      EXPECT_TRUE(std::isfinite(fit.standard_errors.measurement_noise_std_dps));
      EXPECT_NEAR(fit.parameters.delta1_dps, walk_dps, 4.0 * fit.standard_errors.delta1_dps);
      EXPECT_THAT(fit.message, HasSubstr("the noise is coloured"));
    }
}

TEST(RandomError, WithAFilterInTheSensorTheModelAloneHasNoR) {
  const auto z = recorded("noise_bandwidth", {{"cutoff_hz", 10.0}, {"poles", 2.0}});
  EXPECT_LT(fit_arima_likelihood(z).parameters.measurement_noise_std_dps, 0.01 * white_dps);
  EXPECT_GT(fit_random_error(z, FitMethod::likelihood).cluster, 1);
}

TEST(RandomError, WhereTheModelHoldsItsFitIsKept) {
  for (std::uint32_t trial = 0; trial < 10; ++trial) {
    const auto z = recorded("", {}, trial);
    EXPECT_EQ(fit_random_error(z, FitMethod::likelihood).cluster, 1);
    EXPECT_EQ(fit_random_error(z, FitMethod::moments).cluster, 1);
  }
}

// Outliers are no white noise that robust moments had missed.
TEST(RandomError, OutliersDoNotColourTheNoise) {
  const auto z = recorded("outliers", {{"probability", 0.02}, {"std_dps", 0.6}});
  const auto fit = fit_random_error(z, FitMethod::moments);
  EXPECT_EQ(fit.cluster, 1);
  EXPECT_NEAR(fit.parameters.measurement_noise_std_dps, white_dps, 0.1 * white_dps);
  EXPECT_EQ(fit_random_error(z, FitMethod::likelihood).cluster, 1);
}

// A walk with hardly any noise has no R to be told, and no white noise to be put there.
TEST(RandomError, AWalkWithoutNoiseIsNoNoise) {
  Scenario s;
  s.sampling = {300.0, 100.0};
  s.random_error = {
      .phi = 0.5, .delta1_dps = 0.01, .delta2_dps = 0.0, .measurement_noise_std_dps = 1e-6};
  Series series;
  synthesise(s, {.seed = 20250702, .trial = 0}, series);
  EXPECT_EQ(white_means(series.random_error_dps).cluster, 0);
  EXPECT_EQ(fit_random_error(series.random_error_dps, FitMethod::likelihood).cluster, 1);
}

TEST(RandomError, WhiteMeansFindTheDensityOfWhiteNoise) {
  const auto white = recorded("", {});
  EXPECT_EQ(white_means(white).cluster, 8);
  EXPECT_NEAR(white_means(white).white_std_dps, white_dps, 0.05 * white_dps);
  EXPECT_GT(white_means(recorded("noise_bandwidth", {{"cutoff_hz", 5.0}, {"poles", 2.0}})).cluster,
            8);
}

TEST(RandomError, MissingSamplesAreNotMeans) {
  auto z = recorded("noise_bandwidth", {{"cutoff_hz", 20.0}, {"poles", 1.0}});
  for (std::size_t i = 1000; i < 1400; ++i) z[i] = no_value;
  const auto fit = fit_random_error(z, FitMethod::likelihood);
  EXPECT_NEAR(fit.parameters.measurement_noise_std_dps, white_dps, 0.1 * white_dps);
}

/// 1.2 million samples: a walk in white noise, or an error that returns with phi.
std::vector<double> long_recording(double phi) {
  Scenario s;
  s.sampling = {1200.0, 1000.0};
  s.random_error = {.phi = phi,
                    .delta1_dps = phi == 0.0 ? 2e-4 : 0.05,
                    .delta2_dps = 0.0,
                    .measurement_noise_std_dps = white_dps};
  Series series;
  synthesise(s, {.seed = 20261122, .trial = 0}, series);
  return series.gyro_dps;
}

// The walk over clusters of five samples is told to within 2 % by 2^18 means (six times its
// standard error, which the fit states; a false failure once in 5e8).
TEST(RandomError, OfALongRecordingAWalkIsToldByMeansOverAllOfIt) {
  const auto fit = fit_random_error(long_recording(0.0), FitMethod::likelihood);
  EXPECT_EQ(fit.cluster, 5);
  EXPECT_EQ(fit.samples, 1'200'000);
  EXPECT_THAT(fit.message, HasSubstr("means over 5 samples"));
  EXPECT_NEAR(fit.parameters.delta1_dps, 2e-4, 6.0 * fit.standard_errors.delta1_dps);
  EXPECT_NEAR(fit.parameters.measurement_noise_std_dps, white_dps,
              6.0 * fit.standard_errors.measurement_noise_std_dps);
  EXPECT_LT(fit.standard_errors.delta1_dps, 0.1 * 2e-4);
  EXPECT_TRUE(std::isinf(fit.standard_errors.phi));
}

TEST(RandomError, OfALongRecordingAMemoryIsToldByItsMiddle) {
  const auto z = long_recording(0.9);
  const auto fit = fit_random_error(z, FitMethod::likelihood);
  EXPECT_EQ(fit.cluster, 1);
  EXPECT_EQ(fit.samples, std::size_t{1} << 18);
  EXPECT_EQ(fit.first, (z.size() - fit.samples) / 2);
  EXPECT_THAT(fit.message, HasSubstr("in the middle"));
  EXPECT_NEAR(fit.parameters.phi, 0.9, 6.0 * fit.standard_errors.phi);
}

}  // namespace
}  // namespace gyrostat
