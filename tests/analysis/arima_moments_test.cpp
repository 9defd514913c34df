#include <gyrostat/analysis/fits/arima_moments.hpp>

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <ceres/jet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/analysis/spectra/arima_haar.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::arima_moments_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// z = x + v with the increments of x in their stationary state.
std::vector<double> simulate(const Arima111<double>& p, std::size_t n, std::uint32_t trial) {
  std::vector<double> a(n + 1), v(n), z(n);
  NormalStream(1, trial, "a").fill(0, a);
  NormalStream(1, trial, "v").fill(0, v);
  const double kappa = p.phi * p.delta1_dps - p.delta2_dps;
  double u = a[n] * kappa / std::sqrt(1.0 - p.phi * p.phi);
  double x = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    x += u + p.delta1_dps * a[k];
    u = p.phi * u + kappa * a[k];
    z[k] = x + p.measurement_noise_std_dps * v[k];
  }
  return z;
}

Vector<double, 4> as_vector(const Arima111<double>& p) {
  return {p.phi, p.delta1_dps, p.delta2_dps, p.measurement_noise_std_dps};
}

/// Half the variance of the difference of cluster means, summed over all pairs of increments.
double brute_force_variance(const Arima111<double>& p, std::size_t cluster) {
  const long double phi = p.phi, d1 = p.delta1_dps, d2 = p.delta2_dps;
  const long double gamma0 = (d1 * d1 + d2 * d2 - 2 * phi * d1 * d2) / (1 - phi * phi);
  const long double gamma1 = phi * gamma0 - d1 * d2;
  const auto m = static_cast<long>(cluster);
  long double sum = 0;
  for (long i = 1 - m; i < m; ++i)
    for (long j = 1 - m; j < m; ++j) {
      const long lag = std::abs(i - j);
      const long double gamma = lag == 0 ? gamma0 : gamma1 * std::pow(phi, lag - 1);
      sum += static_cast<long double>((m - std::abs(i)) * (m - std::abs(j))) * gamma;
    }
  const auto r = static_cast<long double>(p.measurement_noise_std_dps);
  return static_cast<double>(sum / (2 * m * m) + r * r / m);
}

TEST(ArimaHaar, IsTheSumOverAllCovariances) {
  for (const double phi : {-0.99, -0.5, 0.0, 1e-9, 0.3, 0.9, 0.999})
    for (const double theta : {-1.0, 0.0, 0.3, 1.0})
      for (const std::size_t m : {1, 2, 3, 7, 64, 100}) {
        const Arima111<double> p{phi, 0.7, 0.7 * theta, 0.1};
        const double expected = brute_force_variance(p, m);
        EXPECT_NEAR(arima_allan_variance(p, m) / expected, 1.0, 1e-11)
            << phi << " " << theta << " " << m;
      }
}

TEST(ArimaHaar, OfWhiteNoiseIsROverM) {
  EXPECT_EQ(arima_allan_variance(Arima111<double>{0.3, 0.0, 0.0, 2.0}, 1024), 4.0 / 1024.0);
}

// (2 m^2 + 1) / (6 m), NIST SP 1065's tau / 3 for a discrete walk; phi = theta cancels exactly.
TEST(ArimaHaar, OfARandomWalkNeedsNoSmallCluster) {
  for (const double phi : {0.0, 0.5, -0.9, 0.999999})
    for (const double m : {1.0, 1000.0, 1e6, 1e9}) {
      const Arima111<double> p{phi, 1.0, phi, 0.0};
      EXPECT_NEAR(
          arima_allan_variance(p, static_cast<std::size_t>(m)) * 6.0 * m / (2.0 * m * m + 1.0), 1.0,
          1e-13);
    }
}

// Zhang, Metrologia 45 (2008) 549, the Allan variance of AR(1); theta = 1 makes x one.
TEST(ArimaHaar, OfAnAutoregressionIsZhangs) {
  for (const long double phi : {0.2, 0.9, -0.6, 0.999})
    for (const long double m : {1.0, 10.0, 1000.0, 1e5}) {
      const long double zhang =
          (m - 3 * phi - m * phi * phi + 4 * std::pow(phi, m + 1) - std::pow(phi, 2 * m + 1)) /
          (m * m * (1 - phi) * (1 - phi) * (1 - phi * phi));
      const Arima111<double> p{static_cast<double>(phi), 1.0, 1.0, 0.0};
      const double variance = arima_allan_variance(p, static_cast<std::size_t>(m));
      EXPECT_NEAR(variance / static_cast<double>(zhang), 1.0,
                  1e-9 + 1e-15 * static_cast<double>(m * m))
          << static_cast<double>(phi);
    }
}

TEST(ArimaHaar, DyadicClustersAreTheSame) {
  const Arima111<double> p{0.8, 0.2, 0.1, 1.0};
  const auto variances = dyadic_allan_variances(p, 12);
  for (std::size_t j = 0; j < 12; ++j)
    EXPECT_EQ(variances[j], arima_allan_variance(p, std::size_t{1} << j));
}

TEST(ArimaHaar, JetsCarryItsDerivatives) {
  using Jet = ceres::Jet<double, 4>;
  const Arima111<Jet> jets{Jet(0.6, 0), Jet(0.5, 1), Jet(0.2, 2), Jet(1.0, 3)};
  const auto at = [](const Vector<double, 4>& u) {
    return arima_allan_variance(Arima111<double>{u[0], u[1], u[2], u[3]}, 50);
  };
  const Vector<double, 4> here(0.6, 0.5, 0.2, 1.0);
  const Jet value = arima_allan_variance(jets, 50);
  EXPECT_DOUBLE_EQ(value.a, at(here));
  for (int i = 0; i < 4; ++i) {
    const Vector<double, 4> step = 1e-5 * Vector<double, 4>::Unit(i);
    const double slope = (at(here + step) - at(here - step)) / 2e-5;
    EXPECT_NEAR(value.v[i], slope, 1e-7 * std::abs(slope) + 1e-9) << i;
  }
}

// Two sets of five clusters at 4.5 standard errors, and a chi-square on 13 degrees of freedom below
// its 1 - 1e-5 quantile: 1 false failure in 10000 runs.
TEST(ArimaHaar, IsWhatASimulationShows) {
  const std::size_t n = 200'000, scales = 13;
  for (const Arima111<double>& p :
       {Arima111<double>{0.9, 0.1, 0.03, 1.0}, Arima111<double>{-0.5, 1.0, 0.5, 0.2}}) {
    std::vector<std::size_t> clusters;
    for (std::size_t j = 0; j < scales; ++j) clusters.push_back(std::size_t{1} << j);
    const auto points = overlapping_allan_deviation(simulate(p, n, 0), 1.0, clusters);
    const auto covariance = log_allan_covariance(p, n, scales);
    Eigen::VectorXd error(scales);
    for (std::size_t j = 0; j < scales; ++j)
      error[j] = 2.0 * std::log(points[j].deviation) -
                 std::log(arima_allan_variance(p, clusters[j])) + 0.5 * covariance(j, j);
    for (std::size_t j = 0; j < scales; j += 3)
      EXPECT_LT(std::abs(error[j]), 4.5 * std::sqrt(covariance(j, j)));
    EXPECT_LT(error.dot(covariance.llt().solve(error)), 46.9);
  }
}

TEST(ArimaHaar, VarianceOfWhiteNoiseEstimatesIsTheirDegreesOfFreedom) {
  const std::size_t n = 100'000;
  const auto covariance = log_allan_covariance({0.0, 0.0, 0.0, 1.0}, n, 12);
  const std::vector<std::size_t> clusters = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048};
  const auto points =
      overlapping_allan_deviation(simulate({0.0, 0.0, 0.0, 1.0}, n, 0), 1.0, clusters);
  for (std::size_t j = 0; j < 12; ++j)
    EXPECT_NEAR(covariance(j, j) * points[j].power_law_edf / 2.0, 1.0, 0.05) << j;
}

// Four parameters at 4.5 standard errors: 1 false failure in 30000 runs each.
TEST(ArimaMoments, FindsTheParametersOfASimulation) {
  for (const Arima111<double>& p :
       {Arima111<double>{0.9, 0.1, 0.03, 0.3}, Arima111<double>{0.8, 0.01, -0.005, 0.01},
        Arima111<double>{0.99, 0.05, 0.05, 0.2}}) {
    const auto fit = fit_arima_moments(simulate(p, 200'000, 0));
    EXPECT_TRUE(fit.converged) << fit.message;
    EXPECT_EQ(fit.samples, 200'000U);
    const auto z = (as_vector(fit.parameters) - as_vector(p))
                       .cwiseQuotient(as_vector(fit.standard_errors))
                       .eval();
    EXPECT_LT(z.cwiseAbs().maxCoeff(), 4.5) << z.transpose();
    EXPECT_LT(fit.standard_errors.phi, 0.02);
    EXPECT_DOUBLE_EQ(fit.covariance[2][2], std::pow(fit.standard_errors.delta2_dps, 2));
  }
}

TEST(ArimaMoments, GivesTheSameBitsAndScalesWithTheRate) {
  auto rate = simulate({0.8, 0.1, 0.03, 0.1}, 10'000, 3);
  const auto fit = fit_arima_moments(rate);
  EXPECT_EQ(as_vector(fit.parameters), as_vector(fit_arima_moments(rate).parameters));
  EXPECT_EQ(fit.covariance, fit_arima_moments(rate).covariance);
  for (double& y : rate) y = 8.0 * y;
  const auto scaled = fit_arima_moments(rate);
  EXPECT_EQ(scaled.parameters.phi, fit.parameters.phi);
  EXPECT_EQ(scaled.parameters.delta2_dps, 8.0 * fit.parameters.delta2_dps);
  EXPECT_EQ(scaled.standard_errors.measurement_noise_std_dps,
            8.0 * fit.standard_errors.measurement_noise_std_dps);
}

/// Share of fits whose 95 % intervals hold the truth, for each parameter.
Vector<double, 4> coverage(const Arima111<double>& p, std::size_t n, std::uint32_t fits) {
  Vector<double, 4> covered = Vector<double, 4>::Zero();
  for (std::uint32_t trial = 0; trial < fits; ++trial) {
    const auto fit = fit_arima_moments(simulate(p, n, trial));
    for (int i = 0; i < 4; ++i)
      covered[i] += std::abs(as_vector(fit.parameters)[i] - as_vector(p)[i]) <=
                    1.96 * as_vector(fit.standard_errors)[i];
  }
  return covered / fits;
}

// 200 fits: the standard error of a coverage of 0.95 is 0.0155. Measured with 1000 fits: 0.962,
// 0.973, 0.976, 0.957 for phi, delta1, delta2, sqrt(R); 0.935 to 0.959 with 6000 samples. The limit
// is 4.5 standard errors below 0.95, passed in 1 of 40000 runs of an exact interval.
TEST(ArimaMoments, IntervalsCoverTheTruthWhereAllIsIdentified) {
  EXPECT_GT(coverage({0.8, 0.1, 0.03, 0.1}, 20'000, 200).minCoeff(), 0.95 - 4.5 * 0.0155);
}

// Measured with 1000 fits: 0.942, 0.880, 0.878, 0.931. delta1 and delta2 move together along a
// curved ridge, which an interval of symmetric ends cannot follow. 60 fits: a standard error of
// 0.042.
TEST(ArimaMoments, IntervalsCoverLessWhereTheNoiseHidesDelta1) {
  EXPECT_GT(coverage({0.9, 0.1, 0.03, 0.3}, 6000, 60).minCoeff(), 0.878 - 4.5 * 0.0423);
}

// The likelihood ratio at 99.9 % calls 1 of 1000 random walks more than that. The intensity of the
// walk is known to 3 %.
TEST(ArimaMoments, ARandomWalkIsSaidToBeOne) {
  for (const Arima111<double>& p :
       {Arima111<double>{0.0, 0.1, 0.0, 1.0}, Arima111<double>{0.6, 0.1, 0.06, 0.0}}) {
    const auto fit = fit_arima_moments(simulate(p, 20'000, 0));
    EXPECT_TRUE(fit.converged);
    EXPECT_THAT(fit.message, HasSubstr("cannot be told"));
    EXPECT_EQ(fit.parameters.phi, 0.0);
    EXPECT_EQ(fit.parameters.delta2_dps, 0.0);
    EXPECT_NEAR(fit.parameters.delta1_dps, 0.1, 4.5 * 0.0035);
    EXPECT_GT(fit.standard_errors.phi, 0.3);
    EXPECT_NEAR(0.0, p.phi, 1.96 * fit.standard_errors.phi);
  }
}

// Spikes of 140 times the noise on 1 % of the samples take the noise of those samples with them,
// and shift nothing else by more than half a standard error; the plain Allan variance is 200 times
// too large.
TEST(ArimaMoments, SpikesDoNotShiftIt) {
  const auto rate = simulate({0.9, 0.05, 0.03, 0.1}, 50'000, 5);
  auto spiked = rate;
  for (std::size_t k = 37; k < spiked.size(); k += 100) spiked[k] += k % 3 == 0 ? 14.0 : -14.0;
  const auto clean = fit_arima_moments(rate);
  const auto fit = fit_arima_moments(spiked);
  const auto shift = (as_vector(fit.parameters) - as_vector(clean.parameters)).eval();
  for (int i = 0; i < 4; ++i)
    EXPECT_LT(std::abs(shift[i]),
              0.5 * as_vector(clean.standard_errors)[i] + 0.01 * as_vector(clean.parameters)[i])
        << i;
}

TEST(ArimaMoments, BridgesFewMissingSamplesAndRefusesMany) {
  const auto rate = simulate({0.9, 0.05, 0.03, 0.1}, 50'000, 6);
  const auto with_gaps = [&](std::size_t every) {
    auto gaps = rate;
    for (std::size_t k = 0; k < gaps.size(); k += every)
      gaps[k] = std::numeric_limits<double>::quiet_NaN();
    return gaps;
  };
  const auto whole = fit_arima_moments(rate);
  const auto fit = fit_arima_moments(with_gaps(500));
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(as_vector(fit.parameters)[i], as_vector(whole.parameters)[i],
                as_vector(whole.standard_errors)[i])
        << i;
  EXPECT_THAT([&] { fit_arima_moments(with_gaps(10)); },
              ThrowsMessage<InputError>(HasSubstr("5000 of 50000 samples are missing")));
}

TEST(ArimaMoments, AModelThatDoesNotFitIsSaidNotTo) {
  const Arima111<double> p{0.9, 0.05, 0.03, 0.1};
  auto rate = simulate(p, 20'000, 7);
  const auto before = fit_arima_moments(rate);
  EXPECT_THAT(before.message, Not(HasSubstr("does not describe")));
  for (std::size_t k = 0; k < rate.size(); ++k)
    rate[k] += 0.3 * std::sin(0.3 * static_cast<double>(k));
  const auto fit = fit_arima_moments(rate);
  EXPECT_THAT(fit.message, HasSubstr("does not describe"));
  EXPECT_GT(fit.standard_errors.phi, before.standard_errors.phi);
}

TEST(ArimaMoments, RefusesWhatHasNoNoise) {
  EXPECT_THROW(fit_arima_moments(std::vector<double>(1000, 0.5)), InputError);
  EXPECT_THAT([] { fit_arima_moments(std::vector<double>(511, 0.5)); },
              ThrowsMessage<InputError>(HasSubstr("511 samples")));
}

}  // namespace
}  // namespace gyrostat::arima_moments_test
