// The likelihood of cluster means against dense matrices, and against all histories of jumps.

#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/set_fit.hpp>
#include <gyrostat/diagnosis/likelihood/slow_law.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap::slow_filter_test {
namespace {

const std::vector<std::size_t> points = {0, 1, 2, 3, 7, 8, 9, 15, 16, 17};

Eigen::VectorXd drawn(std::string_view name, Eigen::Index count) {
  const NormalStream stream(7, 0, name);
  Eigen::VectorXd values(count);
  for (Eigen::Index k = 0; k < count; ++k) values[k] = stream.normal(static_cast<std::uint64_t>(k));
  return values;
}

/// Log density of zero-mean normal values.
double log_normal(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  const Eigen::VectorXd white = root.matrixL().solve(values);
  return -0.5 * white.squaredNorm() - root.matrixLLT().diagonal().array().log().sum() -
         0.5 * static_cast<double>(values.size()) * std::log(2.0 * std::numbers::pi);
}

/// Covariance of what the law makes at the points, from a level that is 0 at the first.
Eigen::MatrixXd covariance_of(const SlowLaw& law) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd c(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto first = static_cast<double>(points[static_cast<std::size_t>(std::min(i, j))]);
      const auto last = static_cast<double>(points[static_cast<std::size_t>(std::max(i, j))]);
      c(i, j) = law.walk * first + (i == j ? law.white : 0.0);
      for (const auto& part : law.parts)
        c(i, j) += part.variance * std::pow(part.decay, last - first);
      for (const auto& turning : law.turning)
        c(i, j) += turning.variance * std::pow(turning.decay, last - first) *
                   std::cos(turning.angle * (last - first));
    }
  return c;
}

/// Differences from one value to the next know nothing of the level: their density is the diffuse
/// likelihood.
Eigen::MatrixXd differences() {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(n - 1, n);
  for (Eigen::Index k = 0; k + 1 < n; ++k) d(k, k) = -1.0, d(k, k + 1) = 1.0;
  return d;
}

TEST(SlowFilter, IsTheDensityOfDifferences) {
  const SlowLaw law{.white = 0.5, .walk = 0.03, .parts = {{0.8, 0.7}, {0.2, 0.95}}, .jumps = {}};
  const auto values = drawn("values", 10);
  const Eigen::MatrixXd d = differences();
  const double expected = log_normal(d * values, d * covariance_of(law) * d.transpose());
  const auto terms = slow_terms(law, points, values, Eigen::MatrixXd(10, 0), Eigen::VectorXd());
  EXPECT_NEAR(terms.log_likelihood, expected, 1e-5);
}

TEST(SlowFilter, IsTheDensityOfDifferencesOfWhatTurns) {
  const SlowLaw law{.white = 0.5,
                    .walk = 0.03,
                    .parts = {{0.2, 0.95}},
                    .turning = {{0.8, 0.9, 1.1}, {0.4, 0.7, 2.6}},
                    .jumps = {}};
  const auto values = drawn("values", 10);
  const Eigen::MatrixXd d = differences();
  const double expected = log_normal(d * values, d * covariance_of(law) * d.transpose());
  const auto terms = slow_terms(law, points, values, Eigen::MatrixXd(10, 0), Eigen::VectorXd());
  EXPECT_NEAR(terms.log_likelihood, expected, 1e-5);
}

/// With parts below 0, down to the least that a covariance allows.
TEST(SlowFilter, IsTheDensityOfDifferencesOfASmoothedWalk) {
  constexpr double walk = 0.3, decay = 0.7, least = -0.25 * walk * (1.0 + decay) / (1.0 - decay);
  for (const double share : {0.3, 1.0}) {
    const SlowLaw law{
        .white = 0.05, .walk = walk, .parts = {{share * least, decay}, {0.2, 0.95}}, .jumps = {}};
    const auto values = drawn("values", 10);
    const Eigen::MatrixXd d = differences();
    const double expected = log_normal(d * values, d * covariance_of(law) * d.transpose());
    const auto terms = slow_terms(law, points, values, Eigen::MatrixXd(10, 0), Eigen::VectorXd());
    EXPECT_NEAR(terms.log_likelihood, expected, 1e-5) << share;
  }
}

TEST(SlowFilter, CoefficientsAreIntegratedOutUnderTheirPriors) {
  const SlowLaw law{.white = 0.5, .walk = 0.03, .parts = {{0.8, 0.7}}, .jumps = {}};
  const auto values = drawn("values", 10);
  Eigen::MatrixXd regressors(10, 2);
  regressors << drawn("first", 10), drawn("second", 10);
  const Eigen::Vector2d prior_std(0.7, 2.0);
  const Eigen::MatrixXd of_priors =
      regressors * prior_std.cwiseAbs2().asDiagonal() * regressors.transpose();
  const Eigen::MatrixXd d = differences();
  const double expected =
      log_normal(d * values, d * (covariance_of(law) + of_priors) * d.transpose());
  const auto terms = slow_terms(law, points, values, regressors, prior_std);
  EXPECT_NEAR(terms.log_likelihood, expected, 1e-5);
}

/// Of all histories of two levels, with a walk beside them.
TEST(SlowFilter, FollowsTwoLevelsAsTheSumOverAllHistoriesDoes) {
  SlowLaw law{.white = 0.1, .walk = 0.01, .parts = {}, .jumps = {}};
  const double half = 0.8, per_step = 0.2;
  const Eigen::MatrixXd d = differences();
  const Eigen::MatrixXd covariance = d * covariance_of(law) * d.transpose();
  Eigen::VectorXd values = 0.3 * drawn("values", 10);
  for (const Eigen::Index k : {3, 4, 5, 8}) values[k] += 2.0 * half;
  double sum = 0.0;
  for (int history = 0; history < 1024; ++history) {
    double weight = 0.5;
    Eigen::VectorXd level(10);
    for (Eigen::Index k = 0; k < 10; ++k) {
      level[k] = (history >> k & 1) != 0 ? half : -half;
      if (k == 0) continue;
      const auto i = static_cast<std::size_t>(k);
      const double mean = per_step * static_cast<double>(points[i] - points[i - 1]);
      const double change = 0.5 * (1.0 - std::exp(-2.0 * mean));
      weight *= level[k] == level[k - 1] ? 1.0 - change : change;
    }
    sum += weight * std::exp(log_normal(d * (values - level), covariance));
  }
  law.jumps = {Jumps::To::the_other_level, half, per_step};
  const auto terms = slow_terms(law, points, values, Eigen::MatrixXd(10, 0), Eigen::VectorXd());
  // Histories are merged: a few hundredths of a nat.
  EXPECT_NEAR(terms.log_likelihood, std::log(sum), 0.1);
}

struct Reduced {
  Series series = recorded(still(), 3, false);
  Conditions conditions{series};
  ReducedRate reduced{
      conditions, series.gyro_dps,
      std::make_shared<const RateGrid>(conditions, std::vector<char>(series.size(), 0))};
};

/// The means of a decaying error over clusters have the covariances that integrating its own twice
/// gives: of one that is slow to the clusters the law has them at every lag.
TEST(SlowLaw, HasTheCovariancesOfMeans) {
  const Reduced at_rest;
  const auto& [series, conditions, reduced] = at_rest;
  const double memory_s = 15.0, variance = 4e-4, interval_s = conditions.slow_interval_s();
  const NoiseLaw white{.interval_s = conditions.interval_s(), .white = 0.0025};
  NoiseLaw law = white;
  law.decaying.push_back({variance, memory_s});
  const auto slow = slow_law(reduced, law);
  const double noise = slow_law(reduced, white).white;
  const auto of_the_law = [&](int lag) {
    return slow.parts[0].variance * std::pow(slow.parts[0].decay, lag) +
           (lag == 0 ? slow.white : 0.0);
  };
  // By sums over 400 points a cluster.
  constexpr int points_a_cluster = 400;
  const auto integrated = [&](int lag) {
    double sum = 0.0;
    for (int i = 0; i < points_a_cluster; ++i)
      for (int j = 0; j < points_a_cluster; ++j)
        sum +=
            std::exp(-std::abs(lag + (i - j) / double{points_a_cluster}) * interval_s / memory_s);
    return variance * sum / (points_a_cluster * points_a_cluster) + (lag == 0 ? noise : 0.0);
  };
  for (const int lag : {0, 1, 2, 30})
    EXPECT_NEAR(of_the_law(lag) / integrated(lag), 1.0, 1e-5) << lag;
}

/// Noise through a filter, and a process that has forgotten within a cluster: the covariances with
/// the next two means are those that sums over samples give.
TEST(SlowLaw, HasWhatFastNoiseSharesWithTheNextMeans) {
  const Reduced at_rest;
  const auto& [series, conditions, reduced] = at_rest;
  const auto cluster = static_cast<int>(conditions.cluster());
  const double variance = 4e-4, interval_s = conditions.interval_s();
  const auto expect_as_summed = [&](const NoiseLaw& law, double decay_a_sample, double tolerance) {
    const auto slow = slow_law(reduced, law);
    ASSERT_EQ(slow.parts.size(), 1);
    for (const int lag : {0, 1, 2}) {
      double summed = 0.0;
      for (int i = 0; i < cluster; ++i)
        for (int j = 0; j < cluster; ++j)
          summed += std::pow(decay_a_sample, std::abs(lag * cluster + i - j));
      summed *= variance / (cluster * cluster);
      const double of_the_law = slow.parts[0].variance * std::pow(slow.parts[0].decay, lag) +
                                (lag == 0 ? slow.white : 0.0);
      EXPECT_NEAR(of_the_law, summed, tolerance * summed) << "at lag " << lag;
    }
  };
  const effects::NoiseBandwidth one_pole{.cutoff_hz = 1.0, .poles = 1.0};
  const double decay = std::exp(-2.0 * std::numbers::pi * one_pole.cutoff_hz * interval_s);
  NoiseLaw filtered{.interval_s = interval_s, .white = variance * (1.0 + decay) / (1.0 - decay)};
  filtered.filter = one_pole;
  expect_as_summed(filtered, decay, 1e-3);
  // Beside jumps, whose histories cannot follow white noise of less than none, with the next alone.
  const auto next = [&](const NoiseLaw& law) {
    const auto slow = slow_law(reduced, law);
    EXPECT_TRUE(!law.jumps || slow.white > 0.0);
    return slow.parts.front().variance * slow.parts.front().decay;
  };
  NoiseLaw jumping = filtered;
  jumping.jumps = {Jumps::To::another_level, 0.1, 0.01};
  EXPECT_NEAR(next(jumping), next(filtered), 1e-9 * variance);
  // The means of clusters of samples and of a continuous error differ by u^2 / 12 of a sample's u.
  const double memory_s = 0.45 * conditions.slow_interval_s();
  NoiseLaw forgets{.interval_s = interval_s, .white = 0.0};
  forgets.decaying.push_back({variance, memory_s});
  expect_as_summed(forgets, std::exp(-interval_s / memory_s), 0.02);
}

/// A line below the frequencies that spectra of samples are asked for, and one that the means fold,
/// as sums over samples give them: to a fiftieth of their variance, by which the law's are ahead;
/// of the other, narrower than the bins of the density that its variance is from, to a twelfth.
TEST(SlowLaw, HasTheCovariancesOfTheMeansOfALine) {
  const Reduced at_rest;
  const auto& [series, conditions, reduced] = at_rest;
  const auto cluster = static_cast<int>(conditions.cluster());
  const double interval_s = conditions.interval_s();
  for (const auto& [line, tolerance] : {std::pair{Resonance{4e-4, 0.4, 0.1}, 1.0 / 50.0},
                                        std::pair{Resonance{4e-4, 1.7, 0.03}, 1.0 / 12.0}}) {
    NoiseLaw law{.interval_s = interval_s, .white = 1e-5};
    law.resonances.push_back(line);
    const auto slow = slow_law(reduced, law);
    ASSERT_EQ(slow.turning.size(), 1);
    const auto& turning = slow.turning.front();
    const auto summed = [&](int lag) {
      double sum = 0.0;
      for (int i = 0; i < cluster; ++i)
        for (int j = 0; j < cluster; ++j) {
          const double later_s = interval_s * std::abs(lag * cluster + i - j);
          sum += std::exp(-std::numbers::pi * line.bandwidth_hz * later_s) *
                 std::cos(2.0 * std::numbers::pi * line.centre_hz * later_s);
        }
      return (line.variance * sum + (lag == 0 ? law.white * cluster : 0.0)) / (cluster * cluster);
    };
    for (const int lag : {0, 1, 2, 3, 8}) {
      const double of_the_law =
          turning.variance * std::pow(turning.decay, lag) * std::cos(turning.angle * lag) +
          (lag == 0 ? slow.white : 0.0);
      EXPECT_NEAR(of_the_law, summed(lag), tolerance * summed(0)) << line.centre_hz << ' ' << lag;
    }
  }
}

/// Beside noise that has passed a filter, flicker and an ARIMA(1,1,1) that remembers gained 27 to
/// 63 nats at rest, and hundreds beside a motion, while cluster means were held to be white. Where
/// nothing is left, twice a gain is chi-squared with at most three degrees of freedom: 12 nats are
/// passed once in 40,000 of the sixteen.
TEST(SlowLaw, LeavesNothingOfFilteredNoise) {
  for (const bool moves : {false, true})
    for (const std::uint64_t seed : {11, 12, 13, 14}) {
      Scenario s = moves ? moving() : still();
      s.random_error.phi = 0.0;
      s.effects = {effects::NoiseBandwidth{.cutoff_hz = 1.0, .poles = 1.0}};
      const Series series = recorded(s, seed, moves);
      const Simulator simulator(series, 1);
      const SetBench bench(simulator, series, {});
      const auto filtered = bench.polished(bench.beside_noise(s.effects));
      Scenario flickers = filtered.scenario;
      flickers.effects.push_back(effects::BiasInstability{.coefficient_dps = 0.005});
      for (const auto& more :
           {bench.beside_memory(filtered), bench.polished(bench.refitted(flickers))})
        EXPECT_LT(more.fit.log_likelihood - filtered.fit.log_likelihood, 12.0) << seed;
    }
}

/// Differences of the means of a strong ARIMA(1,1,1), which white noise beside a walk cannot have:
/// the means of a walk move alike from one to the next, and those of a smoothed one for longer.
TEST(SlowLaw, HasTheCovariancesOfTheMeansOfAStrongWalk) {
  const Reduced at_rest;
  const auto& [series, conditions, reduced] = at_rest;
  const std::size_t cluster = conditions.cluster();
  const auto n = static_cast<double>(cluster);
  for (const auto& e :
       {Arima111<double>{0.0, 0.1, 0.0, 0.05}, Arima111<double>{0.9, 0.01, 0.002, 0.05}}) {
    Scenario s;
    s.random_error = e;
    const auto slow = slow_law(reduced, law_of(s, conditions.interval_s()));
    const auto of_the_law = [&](int lag) {
      double sum = lag == 0 ? slow.walk + 2.0 * slow.white : lag == 1 ? -slow.white : 0.0;
      for (const auto& part : slow.parts)
        sum += part.variance * (2.0 * std::pow(part.decay, lag) - std::pow(part.decay, lag + 1) -
                                std::pow(part.decay, std::abs(lag - 1)));
      return sum;
    };
    // Sample by sample: a difference of means is a sum of steps x_k - x_(k-1) with weights that
    // rise over one cluster and fall over the next.
    const auto weight = [&](double k) { return std::max(0.0, 1.0 - std::abs(k - n) / n); };
    const auto step_covariance = [&](int lag) {
      const double square = e.delta1_dps * e.delta1_dps + e.delta2_dps * e.delta2_dps;
      const double product = e.delta1_dps * e.delta2_dps, left = 1.0 - e.phi * e.phi;
      const double at_0 = (square - 2.0 * e.phi * product) / left;
      const double at_1 = ((1.0 + e.phi * e.phi) * -product + e.phi * square) / left;
      return lag == 0 ? at_0 : at_1 * std::pow(e.phi, lag - 1);
    };
    const auto summed = [&](int lag) {
      const double white = e.measurement_noise_std_dps * e.measurement_noise_std_dps / n;
      double sum = lag == 0 ? 2.0 * white : lag == 1 ? -white : 0.0;
      for (int i = 0; i < 2 * static_cast<int>(cluster); ++i)
        for (int j = 0; j < 2 * static_cast<int>(cluster); ++j)
          sum += weight(i) * weight(j) *
                 step_covariance(std::abs(i - j + lag * static_cast<int>(cluster)));
      return sum;
    };
    // The means of clusters of samples and of a continuous error differ by 1 / (2 n^2).
    for (const int lag : {0, 1, 2, 5})
      EXPECT_NEAR(of_the_law(lag), summed(lag), 0.02 * summed(0)) << e.phi << " at lag " << lag;
  }
}

}  // namespace
}  // namespace gyrostat::gap::slow_filter_test
