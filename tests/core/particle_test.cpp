#include <gyrostat/core/filters/particle.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/core/filters/sr_ukf.hpp>
#include <gyrostat/tests/core/arima_signal.hpp>

namespace gyrostat::particle_test {
namespace {

using filters::Kf;
using filters::Particle;
using filters::SrUkf;
using Parameters = ParticleParameters<double>;

/// Model NL with known parameters.
Parameters known(double particles, double seed = 1.0) {
  Parameters p;
  p.phi = 0.5;
  p.delta1_dps = 0.02;
  p.delta2_dps = 0.015;
  p.measurement_noise_std_dps = 0.01;
  p.initial_x_std_dps = p.initial_x_previous_std_dps = 0.02;
  p.initial_phi_std = p.initial_delta1_std_dps = p.initial_delta2_std_dps = 0.0;
  p.particles = particles;
  p.seed = seed;
  return p;
}

/// x with phi, delta1 and no moving average, in white noise of 0.01 dps.
std::vector<double> signal(std::size_t samples, double phi, double delta1,
                           std::uint32_t trial = 0) {
  const NormalStream a(8, trial, "a"), v(8, trial, "v");
  std::vector<double> z(samples);
  double x = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    difference = phi * difference + delta1 * a.normal(k);
    x += difference;
    z[k] = x + 0.01 * v.normal(k);
  }
  return z;
}

TEST(SystematicResampling, GivesEveryIndexItsShareOfPlacesToWithinOne) {
  const NormalStream stream(1, 0, "resampling");
  std::vector<double> weights(37);
  for (std::uint64_t run = 0; run < 100; ++run) {
    double total = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      total += weights[i] = std::exp(2.0 * stream.normal(40 * run + i));
    for (double& w : weights) w /= total;
    std::vector<double> places(weights.size(), 0.0);
    for (const std::size_t i : systematic_resampling(weights, NormalStream(2, 0, "u").uniform(run)))
      places.at(i) += 1.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      EXPECT_LT(std::abs(places[i] - 37.0 * weights[i]), 1.0);
  }
}

TEST(SystematicResampling, IsUnbiased) {
  const std::vector<double> weights = {0.05, 0.3, 0.15, 0.5};
  std::vector<double> places(4, 0.0);
  constexpr int grid = 10000;
  for (int u = 0; u < grid; ++u)
    for (const std::size_t i : systematic_resampling(weights, (u + 0.5) / grid)) places[i] += 1.0;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(places[i] / grid, 4.0 * weights[i], 1e-3);
}

struct Distance {
  double mean = 0.0, mean_error = 0.0;      ///< of the squared distance, and its standard error
  double offset = 0.0, offset_error = 0.0;  ///< of the distance, and its standard error
};

/// The distance of the estimates from Kf's, in Kf's deviations, over a run of 100 samples and
/// `seeds` seeds of the filter's draws.
Distance distance_from_kf(double particles, int seeds) {
  const auto z = signal(100, 0.5, 0.02);
  const auto moments = [&](const std::vector<double>& values) {
    double sum = 0.0, squares = 0.0;
    for (const double v : values) sum += v, squares += v * v;
    const double n = static_cast<double>(values.size()), mean = sum / n;
    return std::pair{mean, std::sqrt((squares / n - mean * mean) / (n - 1.0))};
  };
  std::vector<double> squares, offsets;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto p = known(particles, seed);
    Particle<double> filter(p);
    Kf<double> kf(p);
    double square = 0.0, offset = 0.0;
    for (const double value : z) {
      const auto a = step(filter, value), b = step(kf, value);
      const double d = (a.estimate_dps - b.estimate_dps) / std::sqrt(b.estimate_variance);
      square += d * d / 100.0;
      offset += d / 100.0;
    }
    squares.push_back(square);
    offsets.push_back(offset);
  }
  Distance result;
  std::tie(result.mean, result.mean_error) = moments(squares);
  std::tie(result.offset, result.offset_error) = moments(offsets);
  return result;
}

/// With known parameters the distance from Kf falls as 1 / sqrt(N): N times its mean square is the
/// same at 500 and 2000 particles to within 5 standard errors (fails falsely at 6e-7).
TEST(Particle, WithKnownParametersConvergesToKfAsTheRootOfTheNumberOfParticles) {
  const auto few = distance_from_kf(500, 80), many = distance_from_kf(2000, 80);
  const double difference = 2000.0 * many.mean - 500.0 * few.mean;
  const double error = std::hypot(2000.0 * many.mean_error, 500.0 * few.mean_error);
  EXPECT_LT(std::abs(difference), 5.0 * error);
  EXPECT_GT(2000.0 * many.mean, 1.0);  // independent draws from Kf's posterior would give 1
  EXPECT_LT(2000.0 * many.mean, 3.0);
  EXPECT_LT(std::abs(many.offset), 5.0 * many.offset_error);
  RecordProperty("n_times_square_500", std::to_string(500.0 * few.mean));
  RecordProperty("n_times_square_2000", std::to_string(2000.0 * many.mean));
  RecordProperty("standard_error_of_the_difference", std::to_string(error));
}

TEST(Particle, StatesTheInnovationAndItsVarianceOfKf) {
  const auto p = known(20000);
  Particle<double> filter(p);
  Kf<double> kf(p);
  for (const double z : signal(100, 0.5, 0.02)) {
    const auto a = step(filter, z), b = step(kf, z);
    EXPECT_NEAR(a.innovation_dps, b.innovation_dps, 0.1 * std::sqrt(b.innovation_variance));
    EXPECT_NEAR(a.innovation_variance / b.innovation_variance, 1.0, 0.1);
    EXPECT_NEAR(a.estimate_variance / b.estimate_variance, 1.0, 0.1);
  }
}

Parameters doubted() {
  auto p = known(1000);
  p.phi = 0.4;
  p.delta1_dps = 0.02;
  p.delta2_dps = 0.0;
  p.initial_phi_std = 0.3;
  p.initial_delta1_std_dps = 0.01;
  return p;
}

TEST(Particle, LearnsTheSizeOfTheNoiseThatTheSrUkfCannot) {
  const auto p = doubted();
  NlParameters<double> q;
  static_cast<RandomErrorParameters<double>&>(q) = p;
  static_cast<InitialParameterStates<double>&>(q) = p;
  Particle<double> filter(p);
  SrUkf<double> unscented(q);
  double phi = 0.0, delta1 = 0.0;
  const auto z = signal(4000, 0.7, 0.03);
  for (std::size_t k = 0; k < z.size(); ++k) {
    step(filter, z[k]);
    step(unscented, z[k]);
    if (k < 2000) continue;
    phi += filter.moments(2).first / 2000.0;
    delta1 += filter.moments(3).first / 2000.0;
  }
  EXPECT_NEAR(phi, 0.7, 0.1);
  EXPECT_NEAR(delta1, 0.03, 0.004);
  EXPECT_NEAR(unscented.state().mean()(3), 0.02, 1e-12);
}

TEST(Particle, GivesTheSameBitsOnAnyThreadAndFromACopy) {
  auto z = signal(300, 0.7, 0.03);
  z[50] = no_value;
  const auto run = [&](Particle<double> filter, std::size_t first) {
    std::vector<std::uint64_t> bits;
    for (std::size_t k = first; k < z.size(); ++k) {
      const auto s = step(filter, z[k]);
      bits.push_back(std::bit_cast<std::uint64_t>(s.estimate_dps));
      bits.push_back(std::bit_cast<std::uint64_t>(s.estimate_variance));
    }
    return bits;
  };
  const Particle<double> fresh(doubted());
  const auto expected = run(fresh, 0);
  std::vector<std::vector<std::uint64_t>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = run(fresh, 0); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, expected);

  auto part = fresh;
  for (std::size_t k = 0; k < 100; ++k) step(part, z[k]);
  EXPECT_EQ(run(part, 100), std::vector(expected.begin() + 200, expected.end()));
}

TEST(Particle, AnotherSeedIsAnotherDraw) {
  Particle<double> a(known(100, 1.0)), b(known(100, 2.0));
  EXPECT_NE(step(a, 0.0).estimate_dps, step(b, 0.0).estimate_dps);
}

TEST(Particle, AMissingSampleIsPredictedAndCounted) {
  Particle<double> filter(known(500));
  const auto before = step(filter, 0.01);
  const auto s = step(filter, no_value);
  EXPECT_EQ(s.status, Status::no_measurement);
  EXPECT_TRUE(std::isnan(s.innovation_dps));
  EXPECT_GT(s.estimate_variance, before.estimate_variance);
}

TEST(Particle, ACollapseOfTheWeightsIsCountedAndAnOutlierForgotten) {
  auto z = signal(500, 0.5, 0.02);
  Particle<double> spared(known(500)), struck(known(500));
  double difference = 0.0;
  for (std::size_t k = 0; k < z.size(); ++k) {
    const auto a = step(spared, z[k]), b = step(struck, k == 300 ? z[k] + 100.0 : z[k]);
    EXPECT_EQ(b.status, k == 300 ? Status::not_finite : Status::ok);
    EXPECT_EQ(std::isnan(b.innovation_dps), k == 300);
    if (k >= 310) difference = std::max(difference, std::abs(a.estimate_dps - b.estimate_dps));
  }
  EXPECT_LT(difference, 0.01);
}

TEST(Particle, FindsASignalThatJumped) {
  Particle<double> filter(known(500));
  for (int k = 0; k < 100; ++k) step(filter, 0.0);
  Step<double> s;
  for (int k = 0; k < 50; ++k) s = step(filter, 500.0);
  EXPECT_EQ(s.status, Status::ok);
  EXPECT_NEAR(s.estimate_dps, 500.0, 0.05);
}

TEST(Particle, StaysFiniteWhateverTheData) {
  for (const double noise : {0.0, 0.01}) {
    auto p = doubted();
    p.measurement_noise_std_dps = noise;
    p.particles = 50;
    Particle<double> filter(p);
    for (const double z : {0.0, 1e300, -1e300, std::numeric_limits<double>::infinity(), 0.0, 1e9})
      for (int k = 0; k < 100; ++k) {
        const auto s = step(filter, z);
        ASSERT_TRUE(std::isfinite(s.estimate_dps) && std::isfinite(s.estimate_variance)) << z;
      }
    for (int k = 0; k < 10000; ++k) ASSERT_TRUE(std::isfinite(step(filter, no_value).estimate_dps));
  }
}

}  // namespace
}  // namespace gyrostat::particle_test
