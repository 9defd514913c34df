#include <gyrostat/analysis/spectra/allan.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::allan_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<double> white(std::size_t n, std::uint32_t trial = 0) {
  std::vector<double> rate(n);
  NormalStream(1, trial, "allan test").fill(0, rate);
  return rate;
}

std::vector<double> random_walk(std::size_t n, std::uint32_t trial = 0) {
  auto rate = white(n, trial);
  for (std::size_t i = 1; i < n; ++i) rate[i] += rate[i - 1];
  return rate;
}

double white_deviation(std::size_t m) { return 1.0 / std::sqrt(m); }

double random_walk_deviation(std::size_t m) {
  const double length = static_cast<double>(m);
  return std::sqrt((2.0 * length * length + 1.0) / (6.0 * length));
}

double standard_error(const AllanPoint& point) {
  return point.deviation / std::sqrt(2.0 * point.edf);
}

/// The 1000-point test suite of NIST SP 1065.
std::vector<double> nist_test_set() {
  std::vector<double> rate;
  for (std::uint64_t n = 1234567890; rate.size() < 1000; n = 16807 * n % 2147483647)
    rate.push_back(static_cast<double>(n) / 2147483647.0);
  return rate;
}

TEST(Allan, AgreesWithNistSp1065) {
  const std::vector<std::size_t> clusters = {1, 10, 100};
  const auto points = overlapping_allan_deviation(nist_test_set(), 1.0, clusters);
  // NIST SP 1065 table 31, seven digits.
  EXPECT_NEAR(points[0].deviation, 2.922319e-01, 5e-8);
  EXPECT_NEAR(points[1].deviation, 9.159953e-02, 5e-9);
  EXPECT_NEAR(points[2].deviation, 3.241343e-02, 5e-9);
  EXPECT_EQ(points[2].tau_s, 100.0);
}

TEST(Allan, IsTheMeanSquareDifferenceOfNeighbouringMeans) {
  // tests/reference/allan_reference.py
  const std::vector<std::pair<std::size_t, double>> expected = {
      {1, 2.9223187810675916e-01},  {2, 2.0101604217093849e-01},   {7, 1.1388620253967162e-01},
      {10, 9.1599534201186522e-02}, {100, 3.2413430260569837e-02}, {250, 1.0898683211411454e-02},
  };
  for (const auto& [m, deviation] : expected) {
    const auto points = overlapping_allan_deviation(nist_test_set(), 1.0, std::array{m});
    EXPECT_NEAR(points.front().deviation, deviation, 1e-12 * deviation) << m;
  }
}

// Ten points each; 4.5 standard errors are passed by chance in 1 of 15000 runs of either test.
TEST(Allan, OfWhiteNoiseFallsWithTheRootOfTau) {
  const std::vector<std::size_t> clusters = {1, 2, 5, 10, 30, 100, 300, 1000, 3000, 5000};
  for (const auto& point : overlapping_allan_deviation(white(100'000), 100.0, clusters))
    EXPECT_NEAR(point.deviation, white_deviation(point.cluster), 4.5 * standard_error(point));
}

TEST(Allan, OfARandomWalkRisesWithTheRootOfTau) {
  const std::vector<std::size_t> clusters = {1, 2, 5, 10, 30, 100, 300, 1000, 3000, 5000};
  for (const auto& point : overlapping_allan_deviation(random_walk(100'000), 100.0, clusters))
    EXPECT_NEAR(point.deviation, random_walk_deviation(point.cluster), 4.5 * standard_error(point));
}

/// 2 mean^2 / variance of the mean of w^2 over `count` overlapping windows, from the response of w
/// to the innovations.
double exact_edf(const std::vector<double>& response, std::size_t count) {
  double sum = 0.0;
  double variance = 0.0;
  for (const double h : response) variance += h * h;
  for (std::size_t lag = 0; lag < std::min(count, response.size()); ++lag) {
    double covariance = 0.0;
    for (std::size_t i = lag; i < response.size(); ++i)
      covariance += response[i] * response[i - lag];
    const double weight = (lag == 0 ? 1.0 : 2.0) * static_cast<double>(count - lag);
    sum += weight * std::pow(covariance / variance, 2);
  }
  return static_cast<double>(count * count) / sum;
}

// The rate's own degrees of freedom have a standard error of the root of m / n (measured in NumPy,
// 60 replicas, m from 1 to 200) and a bias of up to 12 m / n, for the squares of covariances that
// are themselves estimates; 4.5 standard errors over ten values: 1 false failure in 15000 runs.
TEST(Allan, DegreesOfFreedomAreThoseOfTheOverlappingWindows) {
  const std::size_t n = 100'000;
  for (const std::size_t m : {1, 3, 10, 100, 200}) {
    std::vector<double> difference(2 * m, 1.0);
    std::fill_n(difference.begin(), m, -1.0);
    std::vector<double> triangle(2 * m - 1);
    for (std::size_t i = 0; i < triangle.size(); ++i)
      triangle[i] = static_cast<double>(std::min(i + 1, 2 * m - 1 - i));
    const std::array cluster = {m};
    const double edf = overlapping_allan_deviation(white(n), 1.0, cluster).front().edf;
    const double ratio = static_cast<double>(m) / static_cast<double>(n);
    const double tolerance = 4.5 * std::sqrt(ratio) + 12.0 * ratio;
    EXPECT_NEAR(edf / exact_edf(difference, n - 2 * m + 1), 1.0, tolerance) << m;
    const double walk_edf = overlapping_allan_deviation(random_walk(n), 1.0, cluster).front().edf;
    EXPECT_NEAR(walk_edf / exact_edf(triangle, n - 2 * m + 1), 1.0, tolerance) << m;
  }
}

struct Law {
  std::function<std::vector<double>(std::size_t, std::uint32_t)> simulate;
  double (*deviation)(std::size_t);
};

/// White noise that gives way to a random walk at three samples.
std::vector<double> crossover(std::size_t count, std::uint32_t trial) {
  auto rate = white(count, trial);
  const auto walk = random_walk(count, trial + 100'000);
  for (std::size_t i = 0; i < count; ++i) rate[i] += walk[i];
  return rate;
}

double crossover_deviation(std::size_t m) {
  return std::hypot(white_deviation(m), random_walk_deviation(m));
}

// 1500 replicas: the standard error of a coverage of 0.95 is 0.0056. Measured with 3000 replicas:
// 0.944 to 0.970, the largest at n/4, where four degrees of freedom are not quite chi-square. The
// limits are 4.5 standard errors beyond these.
TEST(Allan, IntervalsCoverTheTruthAsOftenAsTheySay) {
  const std::size_t n = 1000;
  const std::vector<std::size_t> clusters = {1, 3, 10, 31, 62, 125, 250};
  for (const Law& law : {Law{white, white_deviation}, Law{random_walk, random_walk_deviation},
                         Law{crossover, crossover_deviation}}) {
    std::vector<double> covered(clusters.size());
    const std::uint32_t replicas = 1500;
    for (std::uint32_t trial = 0; trial < replicas; ++trial) {
      const auto points = overlapping_allan_deviation(law.simulate(n, trial), 1.0, clusters);
      for (std::size_t j = 0; j < clusters.size(); ++j) {
        const double truth = law.deviation(clusters[j]);
        covered[j] += (points[j].lower <= truth && truth <= points[j].upper) / double{replicas};
      }
    }
    for (const double coverage : covered) {
      EXPECT_GT(coverage, 0.944 - 0.025);
      EXPECT_LT(coverage, 0.970 + 0.025);
    }
  }
}

TEST(Allan, DoesNotSeeTheMeanAndScalesWithTheRate) {
  auto rate = white(1000);
  const auto before = overlapping_allan_deviation(rate, 1.0);
  for (double& y : rate) y = 1000.0 - 3.0 * y;
  const auto after = overlapping_allan_deviation(rate, 1.0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i].deviation, 3.0 * before[i].deviation, 1e-9);
    EXPECT_NEAR(after[i].upper, 3.0 * before[i].upper, 1e-8);
  }
}

TEST(Allan, OfAConstantIsZero) {
  for (const auto& point : overlapping_allan_deviation(std::vector<double>(100, 0.5), 1.0)) {
    EXPECT_EQ(point.deviation, 0.0);
    EXPECT_EQ(point.upper, 0.0);
  }
}

TEST(Allan, ClustersRiseByEightADecadeToAQuarter) {
  EXPECT_EQ(allan_clusters(400),
            (std::vector<std::size_t>{1, 2, 3, 4, 6, 7, 10, 13, 18, 24, 32, 42, 56, 75, 100}));
  EXPECT_EQ(overlapping_allan_deviation(white(400), 1.0).size(), 15U);
}

TEST(Allan, RefusesWhatItCannotUse) {
  auto rate = white(100);
  const auto with_cluster = [&](std::size_t m) {
    return [&rate, m] { overlapping_allan_deviation(rate, 1.0, std::array{m}); };
  };
  EXPECT_THAT(with_cluster(51), ThrowsMessage<InputError>(HasSubstr("51 is outside [1, 50]")));
  EXPECT_THROW(with_cluster(0)(), InputError);
  EXPECT_THROW(overlapping_allan_deviation(rate, 0.0), InputError);
  EXPECT_THROW(overlapping_allan_deviation(rate, 1.0, {}, 1.0), InputError);
  EXPECT_THROW(overlapping_allan_deviation({}, 1.0), InputError);
  rate[17] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(with_cluster(1), ThrowsMessage<InputError>(HasSubstr("rate[17]")));
}

TEST(Allan, MissingSamplesAreLeftOut) {
  const auto whole = white(20'000);
  auto rate = whole;
  for (std::size_t i = 0; i < rate.size(); ++i)
    if (i % 17 == 3 || (i >= 5000 && i < 7000)) rate[i] = std::numeric_limits<double>::quiet_NaN();
  const auto expected = overlapping_allan_deviation(whole, 1.0);
  const auto got = overlapping_allan_deviation(rate, 1.0);
  std::size_t compared = 0;
  for (const auto& point : got)
    for (const auto& other : expected)
      if (point.cluster == other.cluster) {
        ++compared;
        EXPECT_GT(point.upper, other.lower) << point.cluster;
        EXPECT_LT(point.lower, other.upper) << point.cluster;
        EXPECT_LT(point.edf, other.edf * 1.2);
      }
  EXPECT_GE(compared, 25u);
}

TEST(Allan, BurstsTellTheirOwnTausAlone) {
  const auto noise = white(5'000);
  std::vector<double> rate(100'000, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < noise.size(); ++i) rate[i / 250 * 5000 + i % 250] = noise[i];
  const auto points = overlapping_allan_deviation(rate, 1.0);
  ASSERT_FALSE(points.empty());
  EXPECT_LE(points.back().cluster, 150u);  // two clusters, a fifth of each missing
  EXPECT_LT(points.front().lower, 1.0);
  EXPECT_GT(points.front().upper, 1.0);
}

TEST(WithoutSpikes, LeavesGaussianNoiseAlone) {
  // A deviate lies 5.5 standard deviations from the median of nine in 1 of 10^7 samples.
  const auto rate = white(20'000);
  EXPECT_EQ(without_spikes(rate), rate);
  const auto walk = random_walk(20'000);
  std::size_t changed = 0;
  for (std::size_t i = 0; const double y : without_spikes(walk)) changed += y != walk[i++];
  EXPECT_LT(changed, 20U);
}

TEST(WithoutSpikes, TakesSpikesAndGapsOut) {
  auto rate = white(2000);
  for (const std::size_t i : {0, 100, 101, 1500, 1999}) rate[i] = i % 2 == 0 ? 300.0 : -40.0;
  for (std::size_t i = 700; i < 720; ++i) rate[i] = std::numeric_limits<double>::quiet_NaN();
  const auto clean = without_spikes(rate);
  EXPECT_LT(*std::max_element(clean.begin(), clean.end()), 5.0);
  EXPECT_GT(*std::min_element(clean.begin(), clean.end()), -5.0);
  EXPECT_EQ(clean[400], rate[400]);
}

// 4.5 standard errors over ten values: 1 false failure in 15000 runs.
TEST(RobustAllan, OfGaussianNoiseIsTheAllanVariance) {
  const std::vector<std::size_t> clusters = {1, 4, 16, 64, 256};
  for (const Law& law : {Law{white, white_deviation}, Law{random_walk, random_walk_deviation}}) {
    const auto rate = law.simulate(50'000, 1);
    const auto robust = robust_allan_variances(rate, clusters);
    const auto points = overlapping_allan_deviation(rate, 1.0, clusters);
    for (std::size_t j = 0; j < clusters.size(); ++j)
      EXPECT_NEAR(std::sqrt(robust[j]), law.deviation(clusters[j]),
                  4.5 * standard_error(points[j]));
  }
}

// 82 of 50000 coefficients at 16 times the variance make 3 %; 4.5 standard errors are 9 %.
TEST(RobustAllan, OfABurstIsBounded) {
  auto rate = white(50'000);
  for (std::size_t i = 20'000; i < 20'050; ++i) rate[i] *= 1000.0;
  const std::vector<std::size_t> clusters = {1, 4, 16};
  const auto robust = robust_allan_variances(rate, clusters);
  const auto plain = overlapping_allan_deviation(rate, 1.0, clusters);
  for (std::size_t j = 0; j < clusters.size(); ++j) {
    EXPECT_NEAR(robust[j] * static_cast<double>(clusters[j]), 1.0, 0.12);
    EXPECT_GT(plain[j].deviation / std::sqrt(robust[j]), 10.0);
  }
}

/// Of 1,000 differences one is not 0: the estimate ends at 0 rather than fall for ever.
TEST(RobustAllan, OfARateThatIsAllButConstantIsZero) {
  std::vector<double> rate(1000, 0.25);
  rate[500] = 0.75;
  const std::vector<std::size_t> clusters = {1, 4, 16};
  for (const double variance : robust_allan_variances(rate, clusters)) EXPECT_EQ(variance, 0.0);
}

}  // namespace
}  // namespace gyrostat::allan_test
