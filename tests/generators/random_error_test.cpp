#include <gyrostat/generators/random_error.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace gyrostat::random_error_test {
namespace {

/// Autocovariance of the first difference, an ARMA(1,1) process, at lags 0 and 1 (Brockwell and
/// Davis 1991, sec. 3.3, with the innovation scaled to delta1).
struct Difference {
  double phi, variance, lag1;

  explicit Difference(const Arima111<double>& m)
      : phi(m.phi),
        variance((m.delta1_dps * m.delta1_dps + m.delta2_dps * m.delta2_dps -
                  2.0 * m.phi * m.delta1_dps * m.delta2_dps) /
                 (1.0 - m.phi * m.phi)),
        lag1(m.phi * variance - m.delta1_dps * m.delta2_dps) {}

  double lag(int k) const { return k == 0 ? variance : std::pow(phi, k - 1) * lag1; }
};

const std::vector<Arima111<double>> models = {
    {.phi = 0.3, .delta1_dps = 0.002, .delta2_dps = 0.001},
    {.phi = 0.95, .delta1_dps = 0.002, .delta2_dps = 0.0005},
    {.phi = -0.7, .delta1_dps = 0.01, .delta2_dps = -0.005},
    {.phi = 0.0, .delta1_dps = 1.0, .delta2_dps = 0.0},
    {.phi = 0.5, .delta1_dps = 0.5, .delta2_dps = 2.0},
    {.phi = 0.5, .delta1_dps = 0.0, .delta2_dps = 1.0},
};

std::vector<double> random_error(const Arima111<double>& model, const Noise& noise,
                                 std::size_t samples) {
  std::vector<double> x(samples, 0.0);
  add_random_error(model, noise, x);
  return x;
}

// Over n independent trials the relative error of a variance has standard deviation sqrt(2 / n),
// that of a covariance sqrt((v^2 + c^2) / n). At 5 of them each check fails falsely at 6e-7.
TEST(RandomError, TheFirstDifferenceIsStationaryFromTheFirstSampleOn) {
  constexpr int n = 20000;
  for (const auto& model : models) {
    const Difference d(model);
    double first = 0.0, second = 0.0, product = 0.0, fourth = 0.0;
    for (std::uint32_t trial = 0; trial < n; ++trial) {
      const auto x = random_error(model, {7, trial}, 4);
      first += x[0] * x[0] / n;  // x_{-1} = 0, so x_0 is a difference
      second += (x[1] - x[0]) * (x[1] - x[0]) / n;
      product += x[0] * (x[1] - x[0]) / n;
      fourth += (x[3] - x[2]) * (x[3] - x[2]) / n;
    }
    const double error = d.variance * std::sqrt(2.0 / n);
    EXPECT_NEAR(first, d.variance, 5.0 * error) << "phi " << model.phi;
    EXPECT_NEAR(second, d.variance, 5.0 * error) << "phi " << model.phi;
    EXPECT_NEAR(fourth, d.variance, 5.0 * error) << "phi " << model.phi;
    EXPECT_NEAR(product, d.lag1, 5.0 * std::hypot(d.variance, d.lag1) / std::sqrt(n))
        << "phi " << model.phi;
  }
}

// Bartlett: a sample autocovariance at lag h over n samples has variance
// sum over k of (c_k^2 + c_{k+h} c_{k-h}) / n. At 5 standard errors: 6e-7 each.
TEST(RandomError, OverTimeTheFirstDifferenceHasTheAutocovarianceOfArma11) {
  constexpr int n = 200000;
  for (const auto& model : models) {
    const Difference d(model);
    const auto x = random_error(model, {7, 0}, n + 1);
    for (const int h : {0, 1, 2, 5}) {
      double sample = 0.0;
      for (int i = 1; i + h <= n; ++i) {
        const auto at = static_cast<std::size_t>(i), later = static_cast<std::size_t>(i + h);
        sample += (x[at] - x[at - 1]) * (x[later] - x[later - 1]) / n;
      }
      double variance = 0.0;
      for (int k = -400; k <= 400; ++k)
        variance += (d.lag(std::abs(k)) * d.lag(std::abs(k)) +
                     d.lag(std::abs(k + h)) * d.lag(std::abs(k - h))) /
                    n;
      EXPECT_NEAR(sample, d.lag(h), 5.0 * std::sqrt(variance))
          << "phi " << model.phi << ", lag " << h;
    }
  }
}

TEST(RandomError, ObeysItsRecursionUnderItsOwnDeviates) {
  const Noise noise{3, 5};
  const auto a = noise.stream("random_error");
  for (const auto& m : models) {
    const auto x = random_error(m, noise, 1000);
    for (std::size_t k = 2; k < x.size(); ++k)
      EXPECT_NEAR(x[k],
                  (1.0 + m.phi) * x[k - 1] - m.phi * x[k - 2] + m.delta1_dps * a.normal(k) -
                      m.delta2_dps * a.normal(k - 1),
                  1e-12 * (1.0 + std::abs(x[k])));
  }
}

TEST(RandomError, IsAddedToWhatIsThere) {
  const auto alone = random_error(models[0], {1, 0}, 100);
  std::vector<double> x(100, 2.5);
  add_random_error(models[0], {1, 0}, x);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_DOUBLE_EQ(x[k], 2.5 + alone[k]);
}

TEST(RandomError, AShorterSignalIsAPrefixOfALonger) {
  const auto whole = random_error(models[1], {1, 0}, 1000);
  for (const std::size_t samples : {1, 2, 255, 256, 257, 999})
    EXPECT_EQ(
        random_error(models[1], {1, 0}, samples),
        std::vector<double>(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(samples)));
}

TEST(RandomError, ScalesWithItsDeltas) {
  const auto x = random_error({.phi = 0.4, .delta1_dps = 0.01, .delta2_dps = 0.006}, {1, 0}, 500);
  const auto y = random_error({.phi = 0.4, .delta1_dps = 0.03, .delta2_dps = 0.018}, {1, 0}, 500);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(y[k], 3.0 * x[k], 1e-12);
}

/// With delta2 = phi delta1 the difference is delta1 a_k and nothing else.
TEST(RandomError, WhereTheMovingAverageCancelsTheAutoregressionItIsARandomWalk) {
  const auto x = random_error({.phi = 0.4, .delta1_dps = 0.01, .delta2_dps = 0.004}, {1, 0}, 500);
  const NormalStream a(1, 0, "random_error");
  double walk = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], walk += 0.01 * a.normal(k), 1e-14);
}

// The mean square of n normals has relative standard error sqrt(2 / n), a lag product 1 / sqrt(n);
// at 5 of them each fails falsely at 6e-7.
TEST(WhiteNoise, HasItsStandardDeviationAndNoMemory) {
  constexpr std::size_t n = 200000;
  std::vector<double> v(n, 0.0);
  add_white_noise(0.02, NormalStream(1, 0, "white_noise"), v);
  double square = 0.0, product = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    square += v[k] * v[k] / n;
    if (k > 0) product += v[k] * v[k - 1] / n;
  }
  EXPECT_NEAR(square / 4e-4, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(product / 4e-4, 0.0, 5.0 / std::sqrt(n));
}

TEST(WhiteNoise, OfZeroStrengthChangesNothing) {
  std::vector<double> v = {1.0, -2.0};
  add_white_noise(0.0, NormalStream(1, 0, "white_noise"), v);
  EXPECT_EQ(v, (std::vector<double>{1.0, -2.0}));
}

}  // namespace
}  // namespace gyrostat::random_error_test
