#include <gyrostat/analysis/fits/arima_sums.hpp>

#include <array>
#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <gyrostat/analysis/fits/arima_innovations.hpp>
#include <gyrostat/tests/analysis/simulated_random_error.hpp>

namespace gyrostat::arima_sums_test {
namespace {

constexpr Arima111<double> truth{0.8, 0.003, 0.0028, 0.01};

/// With gaps before, while and after the gains settle, one of them at the end.
std::vector<double> recorded() {
  auto z = simulated(truth, 20000, Noise{20261123, 0});
  for (const std::size_t k : {0, 3, 4, 900, 9000, 9001, 9500, 19999}) z[k] = no_value;
  return z;
}

/// Those of different memory and scale settle at different samples.
const std::vector<Arima111<double>> models = {
    truth,
    {0.0, 0.01, 0.0, 0.001},
    {0.0, 1e-4, 0.0, 0.01},
    {-0.6, 1.0, 0.9, 10.0},
    {0.999, 0.001, 0.0009, 0.02},
    {0.5, 0.01, -0.004, 0.0},
    {0.9, 1.0, 0.95, 1000.0},
    {0.6, 0.01, 0.002, 0.01},
    {0.3, 0.003, 0.001, 0.05},
};

ArimaSums by_definition(const Arima111<double>& model, std::span<const double> z) {
  ArimaSums sums;
  arima_innovations(model, z, [&](double nu, double s) {
    sums.squares += nu * nu / s;
    sums.logs += std::log(s);
    sums.count += 1.0;
  });
  return sums;
}

TEST(ArimaSums, AreThoseOfTheInnovationsForAnyNumberOfModels) {
  const auto z = recorded();
  for (std::size_t many = 1; many <= models.size(); ++many) {
    const auto together = arima_sums(std::span(models).first(many), z);
    ASSERT_EQ(together.size(), many);
    for (std::size_t m = 0; m < many; ++m) {
      SCOPED_TRACE(testing::Message() << "model " << m << " of " << many);
      const auto expected = by_definition(models[m], z), alone = arima_sums(models[m], z);
      for (const auto& found : {together[m], alone}) {
        EXPECT_NEAR(found.squares, expected.squares, 1e-11 * expected.squares);
        EXPECT_NEAR(found.logs, expected.logs, 1e-11 * std::abs(expected.logs));
        EXPECT_EQ(found.count, expected.count);
      }
    }
  }
}

TEST(ArimaSums, HaveTheDerivativesOfTheInnovations) {
  using Jet = ceres::Jet<double, 4>;
  const auto z = recorded();
  for (const auto& model : models) {
    SCOPED_TRACE(testing::Message()
                 << "phi " << model.phi << ", R " << model.measurement_noise_std_dps);
    const Arima111<Jet> jets{Jet(model.phi, 0), Jet(model.delta1_dps, 1), Jet(model.delta2_dps, 2),
                             Jet(model.measurement_noise_std_dps, 3)};
    ArimaDerivatives expected;
    arima_innovations(jets, z, [&](const Jet& nu, const Jet& s) {
      const Jet r = nu / sqrt(s);
      Eigen::Matrix<double, 5, 1> term;
      term << r.v, r.a;
      expected.products += term * term.transpose();
      expected.logs += s.v / s.a;
      expected.information +=
          nu.v * nu.v.transpose() / s.a + s.v * s.v.transpose() / (2.0 * s.a * s.a);
    });
    const auto found = arima_derivatives(model, z);
    EXPECT_TRUE(found.products.isApprox(expected.products, 1e-9));
    EXPECT_TRUE(found.information.isApprox(expected.information, 1e-9));
    EXPECT_TRUE(found.logs.isApprox(expected.logs, 1e-9));
    // A gain is kept once a step changes it by 1e-12, and is 1e-10 off where it forgets slowly.
    EXPECT_NEAR(found.sums.misfit(), arima_sums(model, z).misfit(),
                1e-8 * std::abs(found.sums.misfit()));
  }
}

TEST(ArimaSums, DerivativesOfSeveralAreThoseOfEach) {
  const auto z = recorded();
  for (std::size_t many = 1; many <= models.size(); ++many) {
    const auto together = arima_derivatives(std::span(models).first(many), z);
    ASSERT_EQ(together.size(), many);
    for (std::size_t m = 0; m < many; ++m) {
      const auto alone = arima_derivatives(models[m], z);
      EXPECT_EQ(together[m].products, alone.products);
      EXPECT_EQ(together[m].information, alone.information);
      EXPECT_EQ(together[m].logs, alone.logs);
      EXPECT_EQ(together[m].sums.misfit(), alone.sums.misfit());
    }
  }
}

TEST(ArimaSums, HaveTheGradientOfTheMisfit) {
  const auto z = recorded();
  const auto gradient = arima_derivatives(truth, z).gradient();
  for (int i = 0; i < 4; ++i) {
    constexpr std::array fields = {&Arima111<double>::phi, &Arima111<double>::delta1_dps,
                                   &Arima111<double>::delta2_dps,
                                   &Arima111<double>::measurement_noise_std_dps};
    auto above = truth, below = truth;
    const double step = 1e-5 * truth.*fields[i];
    above.*fields[i] += step;
    below.*fields[i] -= step;
    const double slope =
        (arima_sums(above, z).misfit() - arima_sums(below, z).misfit()) / (2 * step);
    const double rounding = 1e-13 * arima_sums(truth, z).count / step;
    EXPECT_NEAR(gradient[i], slope, 1e-6 * std::abs(slope) + rounding) << i;
  }
}

TEST(ArimaSums, OfNothingAreNothing) {
  const std::vector<double> empty, missing(5, no_value);
  for (const auto& z : {empty, missing}) {
    EXPECT_EQ(arima_sums(truth, z).count, 0.0);
    EXPECT_EQ(arima_derivatives(truth, z).sums.count, 0.0);
  }
}

}  // namespace
}  // namespace gyrostat::arima_sums_test
