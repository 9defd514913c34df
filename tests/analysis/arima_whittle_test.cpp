#include <gyrostat/analysis/fits/arima_whittle.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <gyrostat/analysis/fits/arima_intervals.hpp>
#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/tests/analysis/simulated_random_error.hpp>

namespace gyrostat::arima_whittle_test {
namespace {

constexpr std::size_t samples = 40000;

std::vector<double> simulated(const Arima111<double>& model, std::uint32_t trial) {
  return simulated(model, samples, Noise{20261125, trial});
}

Arima111<double> moved(Arima111<double> model, int parameter, double by) {
  const std::array<double*, 4> of = {&model.phi, &model.delta1_dps, &model.delta2_dps,
                                     &model.measurement_noise_std_dps};
  *of[static_cast<std::size_t>(parameter)] += by;
  return model;
}

TEST(ArimaWhittle, HasTheGradientOfItsValue) {
  const Arima111<double> model{0.8, 0.003, 0.0028, 0.01};
  const ArimaWhittle spectrum(simulated(model, 0));
  ASSERT_TRUE(spectrum.has_terms());
  const auto other = moved(moved(model, 0, -0.1), 1, 0.001);
  const auto there = spectrum.about(other);
  for (int p = 0; p < 4; ++p) {
    const double by = p == 0 ? 1e-5 : 1e-8;
    const double difference =
        (spectrum.about(moved(other, p, by)).value - spectrum.about(moved(other, p, -by)).value) /
        (2.0 * by);
    EXPECT_NEAR(there.gradient[p], difference, 1e-4 * std::abs(difference)) << p;
  }
}

// The gradient that the spectrum has where the exact likelihood has none, in squares of standard
// errors: what one step from there would go. A spectrum with half of the information would be off
// by 4 in the mean, as many as there are parameters.
TEST(ArimaWhittle, IsLeastNearWhereTheExactLikelihoodIs) {
  double sum = 0.0;
  for (const Arima111<double>& model :
       {Arima111<double>{0.8, 0.003, 0.0028, 0.01}, Arima111<double>{0.9, 0.01, 0.0, 0.01}})
    for (std::uint32_t trial = 0; trial < 5; ++trial) {
      const auto z = simulated(model, trial);
      const auto fit = fit_arima_likelihood(z);
      const auto there = ArimaWhittle(z).about(fit.parameters);
      sum += there.gradient.dot(there.information.ldlt().solve(there.gradient));
      for (int p = 0; p < 4; ++p) {
        const double error = std::sqrt(there.information.inverse()(p, p) / fit.covariance[p][p]);
        EXPECT_NEAR(error, 1.0, 0.1) << p;
      }
    }
  EXPECT_LT(sum / 10.0, 4.0);
}

TEST(ArimaWhittle, PassesOverWhatIsMissing) {
  const Arima111<double> model{0.8, 0.003, 0.0028, 0.01};
  auto z = simulated(model, 7);
  const double whole = ArimaWhittle(z).about(model).value;
  z[samples - 1000] = no_value;
  const double broken = ArimaWhittle(z).about(model).value;
  EXPECT_NEAR(broken / whole, 1.0, 0.01);
  z[samples / 2] = no_value;
  EXPECT_FALSE(ArimaWhittle(z).has_terms());
}

// A recording that a missing sample breaks in two is too short for its spectrum: its intervals are
// by the exact likelihood alone. One sample of 40,000 moves an end by a hundredth of a standard
// error at most.
TEST(ArimaWhittle, LeadsToTheIntervalsOfTheExactLikelihood) {
  for (const Arima111<double>& model :
       {Arima111<double>{0.8, 0.003, 0.0028, 0.01}, Arima111<double>{0.9, 0.01, 0.0, 0.01}}) {
    auto z = simulated(model, 11);
    const ArimaIntervals led(fit_arima_likelihood(z), z);
    auto broken = z;
    broken[samples / 2] = no_value;
    const ArimaIntervals exact(fit_arima_likelihood(broken), broken);
    for (const auto p : {ArimaIntervals::phi, ArimaIntervals::delta1, ArimaIntervals::delta2,
                         ArimaIntervals::measurement_noise_std}) {
      const auto [from, to] = led.interval(p);
      const auto [exact_from, exact_to] = exact.interval(p);
      EXPECT_NEAR(from, exact_from, 0.03 * (exact_to - exact_from)) << model.phi << ' ' << p;
      EXPECT_NEAR(to, exact_to, 0.03 * (exact_to - exact_from)) << model.phi << ' ' << p;
    }
  }
}

// A walk of delta1 in white noise R is as likely as one with delta1 delta2 + R' = R for any smaller
// R' (the steps of both are one moving average): the profile is nowhere above the deviance of the
// plain walk, down to no white noise at all.
TEST(ArimaWhittle, FollowsWhatIsEquallyLikelyToItsEnd) {
  for (std::uint32_t trial = 200; trial < 205; ++trial) {
    const auto z = simulated({0.0, 0.002, 0.0, 0.05}, trial);
    const auto fit = fit_arima_likelihood(z);
    const double whole = arima_log_likelihood(*fit.likeliest, z);
    const double of_walk = 2.0 * (whole - fit_walk_likelihood(z).objective);
    const ArimaIntervals intervals(fit, z);
    for (const double noise : {0.0, 0.01, 0.03, 0.045, 0.049})
      EXPECT_LT(intervals.deviance(ArimaIntervals::measurement_noise_std, noise), of_walk + 0.01)
          << trial << ' ' << noise;
  }
}

// A walk in white noise is as well a walk whose steps pay back nearly all of the one before, of no
// white noise. The plain one is reported but where the likelihood rejects it, once in a hundred:
// three or more of 20 come once in a thousand.
TEST(ArimaWhittle, WhiteNoiseBelongsInR) {
  int elsewhere = 0;
  for (std::uint32_t trial = 100; trial < 120; ++trial) {
    const auto fit = fit_arima_likelihood(simulated({0.0, 0.0014, 0.0, 0.05}, trial));
    elsewhere += fit.parameters.measurement_noise_std_dps < 0.04;
  }
  EXPECT_LE(elsewhere, 2);
}

}  // namespace
}  // namespace gyrostat::arima_whittle_test
