#include <gyrostat/analysis/spectra/allan_coefficients.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::allan_coefficients_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double rate_hz = 100.0;

/// Q, N, B, K, R.
using Truth = std::array<double, 5>;

std::array<AllanCoefficient, 5> as_array(const AllanCoefficients& c) {
  return {c.quantisation_deg, c.angle_random_walk_dps_per_sqrt_hz, c.bias_instability_dps,
          c.rate_random_walk_dps_sqrt_hz, c.rate_ramp_dps_per_s};
}

std::vector<double> normals(std::size_t n, std::uint32_t trial, const std::string& stream) {
  std::vector<double> out(n);
  NormalStream(1, trial, stream).fill(0, out);
  return out;
}

/// B^2 / |2 pi f|: a first-order Markov process an octave of corner frequencies.
void add_flicker(std::vector<double>& rate, double b, std::uint32_t trial) {
  const double std = b * std::sqrt(std::numbers::ln2 / std::numbers::pi);
  const double slowest = rate_hz / (50.0 * static_cast<double>(rate.size()));
  for (double corner = 8.0 * rate_hz; corner > slowest; corner /= 2.0) {
    const auto w = normals(rate.size(), trial, "flicker " + std::to_string(corner));
    const double decay = std::exp(-corner / rate_hz);
    double x = std * w[0];
    rate[0] += x;
    for (std::size_t i = 1; i < rate.size(); ++i) {
      x = decay * x + std * std::sqrt(1.0 - decay * decay) * w[i];
      rate[i] += x;
    }
  }
}

std::vector<double> simulate(const Truth& truth, std::size_t n, std::uint32_t trial) {
  const auto [q, white, b, k, ramp] = truth;
  const auto angle = normals(n + 1, trial, "angle");
  const auto noise = normals(n, trial, "white");
  const auto steps = normals(n, trial, "walk");
  std::vector<double> rate(n);
  double walk = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    walk += k / std::sqrt(rate_hz) * steps[i];
    rate[i] = q * rate_hz * (angle[i + 1] - angle[i]) + white * std::sqrt(rate_hz) * noise[i] +
              walk + ramp * static_cast<double>(i) / rate_hz;
  }
  if (b > 0.0) add_flicker(rate, b, trial);
  return rate;
}

/// Points on the curve itself, at octaves from 0.01 s.
std::vector<AllanPoint> exact_points(const Truth& truth, std::size_t count, double edf) {
  AllanCoefficients c;
  c.quantisation_deg.value = truth[0];
  c.angle_random_walk_dps_per_sqrt_hz.value = truth[1];
  c.bias_instability_dps.value = truth[2];
  c.rate_random_walk_dps_sqrt_hz.value = truth[3];
  c.rate_ramp_dps_per_s.value = truth[4];
  std::vector<AllanPoint> points;
  for (std::size_t j = 0; j < count; ++j) {
    const double tau = std::ldexp(0.01, static_cast<int>(j));
    points.push_back({tau, allan_deviation(c, tau), 0.0, 0.0, edf, std::size_t{1} << j, edf});
  }
  return points;
}

TEST(AllanCoefficients, AddUpToTheAllanVarianceOfIeee952) {
  AllanCoefficients c;
  EXPECT_EQ(allan_deviation(c, 4.0), 0.0);
  c.quantisation_deg.value = 2.0;
  EXPECT_DOUBLE_EQ(std::pow(allan_deviation(c, 4.0), 2), 3.0 * 4.0 / 16.0);
  c = {};
  c.angle_random_walk_dps_per_sqrt_hz.value = 2.0;
  EXPECT_DOUBLE_EQ(std::pow(allan_deviation(c, 4.0), 2), 4.0 / 4.0);
  c = {};
  c.bias_instability_dps.value = 2.0;
  EXPECT_NEAR(allan_deviation(c, 4.0), 0.664 * 2.0, 0.001);
  c = {};
  c.rate_random_walk_dps_sqrt_hz.value = 2.0;
  EXPECT_DOUBLE_EQ(std::pow(allan_deviation(c, 4.0), 2), 4.0 * 4.0 / 3.0);
  c = {};
  c.rate_ramp_dps_per_s.value = 2.0;
  EXPECT_DOUBLE_EQ(std::pow(allan_deviation(c, 4.0), 2), 4.0 * 16.0 / 2.0);
}

TEST(AllanCoefficients, AreReadOffTheirOwnCurve) {
  for (const Truth& truth :
       {Truth{1e-3, 0, 0, 0, 0}, Truth{0, 1e-2, 0, 0, 0}, Truth{0, 0, 1e-2, 0, 0},
        Truth{0, 0, 0, 1e-2, 0}, Truth{0, 0, 0, 0, 1e-2}, Truth{0, 1e-2, 0, 2e-2, 0},
        Truth{2e-4, 1e-2, 5e-3, 1e-3, 1e-5}}) {
    const auto fit = fit_allan_coefficients(exact_points(truth, 20, 1e6));
    EXPECT_TRUE(fit.adequate);
    const auto coefficients = as_array(fit);
    for (std::size_t k = 0; k < 5; ++k) {
      const auto& c = coefficients[k];
      EXPECT_NEAR(c.value, truth[k], 1e-3 * truth[k]) << k;
      EXPECT_LE(c.lower, c.value);
      EXPECT_LT(c.value, c.upper);
      EXPECT_EQ(c.value > 0.0, truth[k] > 0.0);
      EXPECT_EQ(std::isnan(c.standard_error), truth[k] == 0.0);
    }
  }
}

// The mean of the log of a chi-square variable on 10 degrees is digamma(5) + log 2 (Abramowitz &
// Stegun 6.3.2: digamma(5) = 1.5061176684), below the log of its mean.
TEST(AllanCoefficients, CorrectTheMeanOfALogarithm) {
  const auto n = fit_allan_coefficients(exact_points({0, 1e-2, 0, 0, 0}, 12, 10.0))
                     .angle_random_walk_dps_per_sqrt_hz;
  EXPECT_NEAR(n.value, 1e-2 * std::exp(0.5 * (std::log(5.0) - 1.5061176684)), 1e-9);
}

// 30 values at 4.5 standard errors: 1 false failure in 5000 runs. A term that is not there is shown
// in 1 record of 100; the standard error is then that of its square.
TEST(AllanCoefficients, AreRecoveredFromNoise) {
  std::uint32_t trial = 0;
  for (const Truth& truth :
       {Truth{0, 1e-2, 0, 0, 0}, Truth{1e-3, 0, 0, 0, 0}, Truth{0, 1e-2, 0, 5e-2, 0},
        Truth{5e-4, 1e-2, 0, 5e-2, 0}, Truth{5e-4, 1e-2, 0, 0, 2e-2}, Truth{0, 1e-2, 0, 0, 2e-2}}) {
    const auto coefficients =
        as_array(fit_allan_coefficients(simulate(truth, 50'000, ++trial), rate_hz));
    for (std::size_t k = 0; k < 5; ++k) {
      const auto& c = coefficients[k];
      EXPECT_GT(c.upper, truth[k]) << k;
      if (truth[k] > 0.0) {
        EXPECT_NEAR(c.value, truth[k], 4.5 * c.standard_error) << k;
        EXPECT_LT(c.standard_error, 0.1 * c.value) << k;
      } else if (c.value > 0.0) {
        EXPECT_LT(c.value, 4.5 * 2.0 * c.standard_error) << k;
      }
    }
  }
}

// The standard error of the standard deviation of n normals is 1 / sqrt(2 n).
TEST(AllanCoefficients, OfWhiteNoiseLoseNothingAgainstItsStandardDeviation) {
  const auto n = fit_allan_coefficients(simulate({0, 1e-2, 0, 0, 0}, 50'000, 1), rate_hz)
                     .angle_random_walk_dps_per_sqrt_hz;
  EXPECT_NEAR(n.standard_error * std::sqrt(2.0 * 50'000.0) / n.value, 1.0, 0.05);
}

TEST(AllanCoefficients, OfARoundedAngleAreItsResolution) {
  const double resolution = 1e-3;
  auto rate = simulate({0, 1e-2, 0, 0, 0}, 50'000, 2);
  double angle = 0.0, before = 0.0;
  for (double& y : rate) {
    angle += (y + 0.5) / rate_hz;
    const double rounded = std::round(angle / resolution) * resolution;
    y = (rounded - before) * rate_hz;
    before = rounded;
  }
  const auto fit = fit_allan_coefficients(rate, rate_hz);
  const auto& q = fit.quantisation_deg;
  EXPECT_NEAR(q.value, resolution / std::sqrt(12.0), 4.5 * q.standard_error);
  EXPECT_LT(q.standard_error, 0.05 * q.value);
  EXPECT_NEAR(fit.angle_random_walk_dps_per_sqrt_hz.value, 1e-2, 2e-4);
}

TEST(AllanCoefficients, OfARoundedRateAreWhiteNoise) {
  const double resolution = 0.5;
  auto rate = simulate({0, 5e-2, 0, 0, 0}, 50'000, 3);
  for (double& y : rate) y = std::round(y / resolution) * resolution;
  const auto fit = fit_allan_coefficients(rate, rate_hz);
  const auto& n = fit.angle_random_walk_dps_per_sqrt_hz;
  const double expected = 2.5e-3 + resolution * resolution / 12.0 / rate_hz;
  EXPECT_NEAR(n.value, std::sqrt(expected), 4.5 * n.standard_error);
  EXPECT_EQ(fit.quantisation_deg.value, 0.0);
}

TEST(AllanCoefficients, OfAWalkSampledWithoutAveragingHoldAWhitePart) {
  const auto fit = fit_allan_coefficients(simulate({0, 0, 0, 5e-2, 0}, 50'000, 4), rate_hz);
  const auto& k = fit.rate_random_walk_dps_sqrt_hz;
  const auto& n = fit.angle_random_walk_dps_per_sqrt_hz;
  EXPECT_NEAR(k.value, 5e-2, 4.5 * k.standard_error);
  EXPECT_NEAR(n.value, 5e-2 / std::sqrt(6.0) / rate_hz, 4.5 * n.standard_error);
}

/// Shares of the records.
struct Tally {
  std::array<double, 5> covered{}, within{}, shown{};
  double adequate = 0.0;
};

Tally tally(const Truth& truth, std::size_t n, std::uint32_t records) {
  const double one = 1.0 / records;
  Tally out;
  for (std::uint32_t trial = 0; trial < records; ++trial) {
    const auto fit = fit_allan_coefficients(simulate(truth, n, trial), rate_hz);
    const auto coefficients = as_array(fit);
    if (fit.adequate) out.adequate += one;
    for (std::size_t k = 0; k < 5; ++k) {
      const auto& c = coefficients[k];
      if (c.lower <= truth[k] && truth[k] <= c.upper) out.covered[k] += one;
      if (std::abs(c.value - truth[k]) <= 1.96 * c.standard_error) out.within[k] += one;
      if (c.value > 0.0) out.shown[k] += one;
    }
  }
  return out;
}

// 300 records: the standard error of a coverage of 0.95 is 0.0126; limits at 4.5. Measured with
// 400: intervals of N 0.978, of K 0.993 (they allow for what the other terms might be), value
// +- 1.96 standard errors 0.955 and 0.973.
TEST(AllanCoefficients, IntervalsOfNAndKCoverTheTruth) {
  const auto counts = tally({0, 1e-2, 0, 5e-2, 0}, 8192, 300);
  for (const std::size_t k : {1, 3}) {
    EXPECT_GT(counts.covered[k], 0.95 - 4.5 * 0.0126) << k;
    EXPECT_GT(counts.within[k], 0.95 - 4.5 * 0.0126) << k;
    EXPECT_NEAR(counts.shown[k], 1.0, 1e-9) << k;
  }
  for (const std::size_t k : {0, 2, 4}) {
    EXPECT_GT(counts.covered[k], 0.95 - 4.5 * 0.0126) << k;
    EXPECT_LT(counts.shown[k], 0.01 + 4.5 * 0.006) << k;
  }
  EXPECT_GT(counts.adequate, 0.97 - 4.5 * 0.01);
}

// Measured with 400: 0.953 to 0.973, and 0.93 within 1.96 standard errors.
TEST(AllanCoefficients, IntervalsCoverTheTruthUnderQuantisation) {
  const auto counts = tally({5e-4, 1e-2, 0, 0, 0}, 4096, 200);
  for (const std::size_t k : {0, 1}) {
    EXPECT_GT(counts.covered[k], 0.95 - 4.5 * 0.0154) << k;
    EXPECT_GT(counts.within[k], 0.93 - 4.5 * 0.0154) << k;
  }
  EXPECT_GT(tally({1e-3, 0, 0, 0, 0}, 4096, 200).within[0], 0.94 - 4.5 * 0.0154);
}

// A walk that shows in some records only: what is not shown is still within the limit.
TEST(AllanCoefficients, ATermTooWeakToShowIsBelowItsLimit) {
  const auto counts = tally({0, 1e-2, 0, 5e-3, 0}, 8192, 200);
  EXPECT_LT(counts.shown[3], 0.9);
  EXPECT_GT(counts.shown[3], 0.4);
  EXPECT_GT(counts.covered[3], 0.95 - 4.5 * 0.0154);
}

// Twenty records at 4.5 standard errors of their mean. The process is 1/f to 1e-5 between its
// corner frequencies; what it has above half the rate of sampling turns up as white noise.
TEST(AllanCoefficients, FindTheBiasInstabilityOfFlickerNoise) {
  const double truth = 2e-2;
  const int records = 20;
  double error = 0.0, variance = 0.0, covered = 0.0;
  for (int trial = 0; trial < records; ++trial) {
    const auto rate = simulate({0, 1e-2, truth, 0, 0}, 32'768, static_cast<std::uint32_t>(trial));
    const auto b = fit_allan_coefficients(rate, rate_hz).bias_instability_dps;
    error += (b.value - truth) / records;
    variance += std::pow(b.standard_error / records, 2);
    if (b.lower <= truth && truth <= b.upper) covered += 1.0;
  }
  EXPECT_NEAR(error, 0.0, 4.5 * std::sqrt(variance));
  EXPECT_LT(std::sqrt(variance), 0.02 * truth);
  EXPECT_GE(covered, 16);
}

TEST(AllanCoefficients, ATermThatAnotherCouldReplaceReachesDownToZero) {
  const Truth truth = {0, 1e-2, 0, 1e-2, 0};
  const auto vague = fit_allan_coefficients(exact_points(truth, 10, 30.0));
  EXPECT_GT(vague.rate_random_walk_dps_sqrt_hz.value, 0.0);
  EXPECT_EQ(vague.rate_random_walk_dps_sqrt_hz.lower, 0.0);
  EXPECT_GT(vague.bias_instability_dps.upper, 0.005);
  const auto precise = fit_allan_coefficients(exact_points(truth, 10, 1e6));
  EXPECT_GT(precise.rate_random_walk_dps_sqrt_hz.lower, 0.0);
}

// Measured over moving averages of 2 to 8 samples: N comes out 1 to 6 % too low.
TEST(AllanCoefficients, AFilterInTheGyroIsNoticedAndDoesNotDecideN) {
  for (const std::size_t width : {2, 4, 8}) {
    auto rate = simulate({0, 1e-2, 0, 0, 0}, 100'000, 5);
    for (std::size_t i = 0; i + width <= rate.size(); ++i)
      rate[i] = std::accumulate(&rate[i], &rate[i] + width, 0.0) / static_cast<double>(width);
    const auto fit = fit_allan_coefficients(rate, rate_hz);
    EXPECT_GT(fit.shortest_tau_s, 0.02);
    EXPECT_NEAR(fit.angle_random_walk_dps_per_sqrt_hz.value, 1e-2, 0.08 * 1e-2) << width;
  }
}

TEST(AllanCoefficients, ABiasOfFirstOrderIsNoticedAndWidensTheErrors) {
  auto rate = simulate({0, 1e-2, 0, 0, 0}, 100'000, 6);
  const auto alone = fit_allan_coefficients(rate, rate_hz);
  EXPECT_TRUE(alone.adequate);
  EXPECT_EQ(alone.shortest_tau_s, 0.01);
  double bias = 0.0;
  for (std::size_t i = 0; const double w : normals(rate.size(), 6, "bias")) {
    bias = 0.99 * bias + 0.01 * w;
    rate[i++] += bias;
  }
  const auto fit = fit_allan_coefficients(rate, rate_hz);
  EXPECT_FALSE(fit.adequate);
  EXPECT_GT(fit.chi_square, 100.0);
  EXPECT_GT(fit.angle_random_walk_dps_per_sqrt_hz.standard_error,
            2.0 * alone.angle_random_walk_dps_per_sqrt_hz.standard_error);
  EXPECT_NEAR(fit.angle_random_walk_dps_per_sqrt_hz.value, 1e-2, 0.1 * 1e-2);
}

TEST(AllanCoefficients, FollowTheUnitsOfRateAndTime) {
  auto rate = simulate({5e-4, 1e-2, 0, 5e-2, 0}, 20'000, 6);
  const auto before = as_array(fit_allan_coefficients(rate, rate_hz));
  for (double& y : rate) y = 1000.0 - 8.0 * y;
  const auto after = as_array(fit_allan_coefficients(rate, rate_hz / 4.0));
  const Truth factor = {32.0, 16.0, 8.0, 4.0, 2.0};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(after[k].value, factor[k] * before[k].value, 1e-4 * after[k].upper) << k;
    EXPECT_NEAR(after[k].upper, factor[k] * before[k].upper, 1e-3 * after[k].upper) << k;
  }
}

TEST(AllanCoefficients, UsePointsAnOctaveApart) {
  const auto rate = simulate({0, 1e-2, 0, 5e-2, 0}, 20'000, 7);
  const auto points = overlapping_allan_deviation(rate, rate_hz);
  std::vector<AllanPoint> apart;
  for (const std::size_t m : {1, 2, 4, 10, 24, 56, 133, 316, 750, 1778, 4217})
    apart.push_back(*std::find_if(points.begin(), points.end(),
                                  [&](const AllanPoint& p) { return p.cluster == m; }));
  const auto all = as_array(fit_allan_coefficients(points));
  const auto some = as_array(fit_allan_coefficients(apart));
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(all[k].upper, some[k].upper);
}

TEST(AllanCoefficients, ConvertToTheCustomaryUnits) {
  EXPECT_DOUBLE_EQ(quantisation_arcsec(0.5), 1800.0);
  EXPECT_DOUBLE_EQ(angle_random_walk_deg_per_sqrt_h(0.005), 0.3);
  EXPECT_DOUBLE_EQ(bias_instability_deg_per_h(0.01), 36.0);
  EXPECT_DOUBLE_EQ(rate_random_walk_deg_per_h_per_sqrt_h(1e-3), 216.0);
  EXPECT_DOUBLE_EQ(rate_ramp_deg_per_h2(1e-5), 129.6);
}

TEST(AllanCoefficients, OctaveClustersEndAtAnEighth) {
  EXPECT_EQ(octave_clusters(128), (std::vector<std::size_t>{1, 2, 4, 8, 16}));
  EXPECT_EQ(octave_clusters(127), (std::vector<std::size_t>{1, 2, 4, 8}));
  EXPECT_TRUE(octave_clusters(7).empty());
}

TEST(AllanCoefficients, RefuseWhatTheyCannotUse) {
  const auto rate = simulate({0, 1e-2, 0, 0, 0}, 128, 0);
  EXPECT_NO_THROW(fit_allan_coefficients(rate, rate_hz));
  const auto fit = [](auto... arguments) { return [=] { fit_allan_coefficients(arguments...); }; };
  EXPECT_THAT(fit(std::span(rate).first(127), rate_hz),
              ThrowsMessage<InputError>(HasSubstr("4 are an octave apart; at least 5")));
  EXPECT_THROW(fit(std::span(rate).first(3), rate_hz)(), InputError);
  EXPECT_THAT(fit(std::vector<double>(1000, 0.5), rate_hz),
              ThrowsMessage<InputError>(HasSubstr("points[0]: tau, deviation")));
  auto points = exact_points({0, 1e-2, 0, 0, 0}, 6, 10.0);
  points[3].power_law_edf = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(fit(points), ThrowsMessage<InputError>(HasSubstr("points[3]")));
  points[3] = points[2];
  EXPECT_THAT(fit(points), ThrowsMessage<InputError>(HasSubstr("points[3]: tau does not rise")));
}

}  // namespace
}  // namespace gyrostat::allan_coefficients_test
