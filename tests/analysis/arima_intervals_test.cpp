#include <gyrostat/analysis/fits/arima_intervals.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/tests/analysis/simulated_random_error.hpp>

namespace gyrostat::arima_intervals_test {
namespace {

std::vector<double> simulated(const Arima111<double>& model, std::size_t samples,
                              std::uint32_t trial) {
  return simulated(model, samples, Noise{20250602, trial});
}

constexpr double reach = 1.959963984540054;

TEST(ArimaIntervals, AreThoseOfTheStandardErrorsWhereTheSignalTellsAllParameters) {
  const auto z = simulated({0.9, 0.02, 0.004, 0.02}, 20000, 0);
  const auto fit = fit_arima_likelihood(z);
  const ArimaIntervals intervals(fit, z);
  const auto expect = [&](ArimaIntervals::Parameter p, double estimate, double error) {
    const auto [from, to] = intervals.interval(p);
    EXPECT_NEAR(estimate - from, reach * error, 0.25 * reach * error) << p;
    EXPECT_NEAR(to - estimate, reach * error, 0.25 * reach * error) << p;
  };
  const auto &e = fit.parameters, &s = fit.standard_errors;
  expect(ArimaIntervals::phi, e.phi, s.phi);
  expect(ArimaIntervals::delta1, e.delta1_dps, s.delta1_dps);
  expect(ArimaIntervals::delta2, e.delta2_dps, s.delta2_dps);
  expect(ArimaIntervals::measurement_noise_std, e.measurement_noise_std_dps,
         s.measurement_noise_std_dps);
}

// What every other parameter can make of it, on a grid so fine that it misses little.
TEST(ArimaIntervals, TheDevianceIsThatOfTheBestOfAllOtherParameters) {
  const auto z = simulated({0.5, 0.02, 0.005, 0.02}, 120, 1);
  const ArimaIntervals intervals(fit_arima_likelihood(z), z);
  const double highest = fit_whole_arima_likelihood(z).objective;
  for (const double phi : {-0.5, 0.3, 0.8}) {
    double best = -1e300;
    for (double theta = -0.99; theta < 1.0; theta += 0.02)
      for (double delta1 = 0.002; delta1 < 0.06; delta1 *= 1.05)
        for (double noise = 0.001; noise < 0.05; noise *= 1.05)
          best = std::max(best, arima_log_likelihood({phi, delta1, theta * delta1, noise}, z));
    const double by_grid = 2.0 * (highest - best);
    EXPECT_LE(intervals.deviance(ArimaIntervals::phi, phi), by_grid + 1e-6) << phi;
    EXPECT_NEAR(intervals.deviance(ArimaIntervals::phi, phi), by_grid, 0.05) << phi;
  }
}

TEST(ArimaIntervals, EndWhereTheTestBeginsToReject) {
  const auto z = simulated({0.8, 0.008, 0.002, 0.02}, 1000, 2);
  const ArimaIntervals intervals(fit_arima_likelihood(z), z);
  for (const auto p : {ArimaIntervals::phi, ArimaIntervals::delta1, ArimaIntervals::delta2,
                       ArimaIntervals::measurement_noise_std})
    for (const double end : intervals.interval(p)) {
      const bool is_limit = p == ArimaIntervals::phi ? std::abs(end) == 1.0 : end == 0.0;
      if (is_limit) continue;
      EXPECT_NEAR(std::sqrt(intervals.deviance(p, end)), reach, 0.06) << p << ' ' << end;
    }
}

TEST(ArimaIntervals, ReachTheEndsOfWhatASignalDoesNotTell) {
  std::vector<double> white(3000);
  NormalStream(3, 0, "white").fill(0, white);
  const auto fit = fit_arima_likelihood(white);
  const ArimaIntervals intervals(fit, white);
  EXPECT_EQ(intervals.interval(ArimaIntervals::phi)[0], -1.0);
  EXPECT_EQ(intervals.interval(ArimaIntervals::delta1)[0], 0.0);
  const auto [from, to] = intervals.interval(ArimaIntervals::delta2);
  EXPECT_LE(from, 0.0);
  EXPECT_GE(to, 0.0);
  // What is reported lies inside, although it is of a simpler model.
  const auto noise = intervals.interval(ArimaIntervals::measurement_noise_std);
  EXPECT_LE(noise[0], fit.parameters.measurement_noise_std_dps);
  EXPECT_GE(noise[1], fit.parameters.measurement_noise_std_dps);
  EXPECT_THROW(ArimaIntervals(ArimaFit{}, std::vector<double>(20, 1.0)), InputError);
}

// A walk of long memory far below white noise: the fit is a plain walk, or lies on another maximum.
// No chance is in it: what the test of one value does not reject, the interval must hold.
TEST(ArimaIntervals, HoldEveryMaximumOfTheLikelihood) {
  constexpr double truth = 0.95;
  int fits_elsewhere = 0;
  for (std::uint32_t trial = 0; trial < 8; ++trial) {
    const auto z = simulated({truth, 1e-4, 5e-5, 0.02}, 6000, Noise{77, trial});
    const auto fit = fit_arima_likelihood(z);
    const ArimaIntervals intervals(fit, z);
    const auto [from, to] = intervals.interval(ArimaIntervals::phi);
    if (intervals.holds(ArimaIntervals::phi, truth)) {
      EXPECT_LE(from, truth) << trial;
      EXPECT_GE(to, truth) << trial;
    }
    if (!(std::abs(fit.parameters.phi - truth) > 10.0 * fit.standard_errors.phi)) continue;
    ++fits_elsewhere;
    EXPECT_FALSE(intervals.other_modes().empty()) << trial;
    EXPECT_GE(to, truth) << trial;
  }
  EXPECT_GT(fits_elsewhere, 0);  // trial 6: phi = -0.04 ± 0.013
}

TEST(ArimaIntervals, KnowOfNoOtherMaximumWhereThereIsNone) {
  const auto z = simulated({0.9, 0.02, 0.004, 0.02}, 5000, 0);
  EXPECT_TRUE(ArimaIntervals(fit_arima_likelihood(z), z).other_modes().empty());
}

}  // namespace
}  // namespace gyrostat::arima_intervals_test
