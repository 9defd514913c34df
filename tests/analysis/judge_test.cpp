// One pass in lanes against one lane alone, bit by bit, and against two passes in long double.

#include <gyrostat/analysis/judge/judge.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <new>

#include <gtest/gtest.h>

#include <gyrostat/analysis/judge/kernels.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::judge_test {
namespace {

constexpr std::size_t samples = 1000;  // not a whole number of stretches
constexpr int trials = 8;
constexpr double u = std::numeric_limits<double>::epsilon() / 2.0;

struct Trial {
  Series series;
  Track track;
};

/// Trial l with what may happen to a trial: 1 misses samples of the gyro, 2 states no variance, 3
/// has no innovations, 4 has what no filter should have, 5 is far from zero, 6 breaks down, 7 has
/// variances beyond what a product of some holds.
Trial trial_of(int l) {
  Trial made;
  auto& [series, track] = made;
  track.resize(samples);
  const auto fill = [&](const char* name, std::vector<double>& to) {
    to.resize(samples);
    NormalStream(5, static_cast<std::uint32_t>(l), name).fill(0, to);
  };
  fill("gyro", series.gyro_dps);
  fill("rate", series.rate_ref_dps);
  fill("drift", series.thermal_bias_dps);
  fill("random", series.random_error_dps);
  fill("estimate", track.estimate_dps);
  fill("innovation", track.innovation_dps);
  fill("variance", track.estimate_variance);
  fill("spread", track.innovation_variance);
  for (std::size_t i = 0; i < samples; ++i) {
    series.t_s.push_back(0.01 * static_cast<double>(i) + 1e-4 * static_cast<double>(i % 7));
    track.estimate_variance[i] = 0.5 + std::abs(track.estimate_variance[i]);
    track.innovation_variance[i] = i < 500 ? 1.5 : 0.5 + std::abs(track.innovation_variance[i]);
    track.status[i] = Status::ok;
    if (l == 1 && i % 97 < 3) series.gyro_dps[i] = no_value;
    if (l == 2) track.estimate_variance[i] = no_value;
    if (l == 3) {
      track.innovation_dps[i] = track.innovation_variance[i] = no_value;
      track.status[i] = Status::no_measurement;
    }
    if (l == 4 && i % 50 == 9) track.innovation_variance[i] = i % 100 == 9 ? -1.0 : 0.0;
    if (l == 4 && i % 50 == 11) track.innovation_dps[i] = i % 100 == 11 ? INFINITY : no_value;
    if (l == 4 && i % 50 == 13) track.innovation_variance[i] = INFINITY;
    if (l == 5) series.gyro_dps[i] = 1e6 + 1e-3 * series.gyro_dps[i];
    if (l == 6 && i > 300 && i % 5 == 0) track.status[i] = static_cast<Status>(i % 4 + 1);
    if (l == 7) track.innovation_variance[i] *= i % 3 == 0 ? 1e-200 : i % 3 == 1 ? 1e200 : 1e-305;
  }
  return made;
}

/// An innovation now and then, as thermal methods have them, and none for whole stretches.
bool has_innovation(std::size_t i) { return i / 100 % 2 == 0 && i % 5 == 0; }

Trial rarely_updated(int l) {
  Trial made = trial_of(l == 6 ? l : 0);
  NormalStream(6, static_cast<std::uint32_t>(l), "innovation").fill(0, made.track.innovation_dps);
  for (std::size_t i = 0; i < samples; ++i) {
    if (has_innovation(i)) continue;
    made.track.innovation_dps[i] = made.track.innovation_variance[i] = no_value;
    if (made.track.status[i] == Status::ok) made.track.status[i] = Status::no_measurement;
  }
  return made;
}

std::vector<double> numbers_in(const TrackErrors& e) {
  std::vector<double> numbers;
  for (const auto* moments : {&e.rate, &e.bias})
    numbers.insert(numbers.end(), {static_cast<double>(moments->count), moments->mean, moments->std,
                                   moments->rmse});
  const auto& i = e.innovations;
  numbers.insert(numbers.end(),
                 {static_cast<double>(i.count), i.nis, i.log_score, i.lag_1, i.ljung_box});
  numbers.insert(numbers.end(), i.pit.begin(), i.pit.end());
  numbers.insert(numbers.end(), e.steps.begin(), e.steps.end());
  const auto& c = e.covariance;
  numbers.insert(numbers.end(),
                 {c.nees, c.nees_end, c.within_1_sigma, c.within_3_sigma, e.heading.end_deg,
                  e.heading.min_deg, e.heading.max_deg, e.first_breakdown_s});
  return numbers;
}

/// All trials by the kernel for so many lanes.
std::vector<TrackErrors> judged_in_lanes(const JudgeKernel& kernel, Trial (*trial_of)(int)) {
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  std::vector<std::vector<double>> channels(10, std::vector<double>(samples * lanes));
  std::vector<Trial> all;
  for (int l = 0; l < kernel.lanes; ++l) all.push_back(trial_of(l));
  for (std::size_t l = 0; l < lanes; ++l) {
    const auto& [s, t] = all[l];
    for (std::size_t k = 0; k < samples; ++k) {
      const double values[] = {s.t_s[k],
                               s.gyro_dps[k],
                               s.rate_ref_dps[k],
                               s.thermal_bias_dps[k],
                               s.random_error_dps[k],
                               t.estimate_dps[k],
                               t.estimate_variance[k],
                               t.innovation_dps[k],
                               t.innovation_variance[k],
                               static_cast<double>(t.status[k])};
      for (std::size_t c = 0; c < channels.size(); ++c) channels[c][k * lanes + l] = values[c];
    }
  }
  void* state = ::operator new (kernel.bytes, std::align_val_t{64});
  kernel.start(state);
  for (std::size_t first = 0; first < samples; first += JudgedSteps::most) {
    const auto at = [&](std::size_t c) { return channels[c].data() + first * lanes; };
    kernel.add(state, {std::min(JudgedSteps::most, samples - first), at(0), at(1), at(2), at(3),
                       at(4), at(5), at(6), at(7), at(8), at(9)});
  }
  std::vector<TrackErrors> errors(lanes);
  kernel.finish(state, errors.data());
  ::operator delete (state, std::align_val_t{64});
  return errors;
}

void expect_the_bits_of_one_alone(Trial (*trial_of)(int)) {
  int compared = 0;
  for (const int lanes : {2, 4, 8, 16}) {
    const auto* kernel = judge_kernel(lanes);
    if (kernel == nullptr) continue;
    const auto together = judged_in_lanes(*kernel, trial_of);
    for (int l = 0; l < lanes; ++l) {
      const Trial alone = trial_of(l);
      const auto expected = numbers_in(track_errors(alone.series, alone.track));
      const auto got = numbers_in(together[l]);
      for (std::size_t n = 0; n < expected.size(); ++n, ++compared)
        EXPECT_TRUE(std::isnan(expected[n]) ? std::isnan(got[n])
                                            : std::bit_cast<std::uint64_t>(got[n]) ==
                                                  std::bit_cast<std::uint64_t>(expected[n]))
            << lanes << ", " << l << ", " << n << ": " << got[n] << ", " << expected[n];
    }
  }
  EXPECT_GE(compared, 2 * 37);
}

TEST(Judge, ALaneHasTheBitsThatItHasAlone) {
  expect_the_bits_of_one_alone(&trial_of);
  expect_the_bits_of_one_alone(&rarely_updated);
}

/// Steps without an innovation are as if they had not been there.
TEST(Judge, RareInnovationsAreJudgedAsIfTheyFollowedEachOther) {
  const auto [series, track] = rarely_updated(3);
  Trial dense;
  for (std::size_t i = 0; i < samples; ++i) {
    if (!has_innovation(i)) continue;
    const std::size_t k = dense.series.size();
    dense.track.resize(k + 1);
    dense.series.t_s.push_back(series.t_s[i]);
    dense.series.gyro_dps.push_back(series.gyro_dps[i]);
    dense.track.innovation_dps[k] = track.innovation_dps[i];
    dense.track.innovation_variance[k] = track.innovation_variance[i];
  }
  const auto rare = track_errors(series, track), all = track_errors(dense.series, dense.track);
  EXPECT_EQ(rare.innovations.count, 100U);
  EXPECT_EQ(rare.innovations.nis, all.innovations.nis);
  EXPECT_EQ(rare.innovations.log_score, all.innovations.log_score);
  EXPECT_EQ(rare.innovations.lag_1, all.innovations.lag_1);
  EXPECT_EQ(rare.innovations.ljung_box, all.innovations.ljung_box);
  EXPECT_EQ(rare.innovations.pit, all.innovations.pit);
  EXPECT_EQ(rare.steps[0], 100.0);
  EXPECT_EQ(rare.steps[1], 900.0);
}

/// Two passes over `values`, NaN left out.
struct TwoPasses {
  long double count = 0.0, mean = 0.0, std = 0.0, rmse = 0.0;

  explicit TwoPasses(const std::vector<long double>& values) {
    long double squares = 0.0, spread = 0.0;
    for (const auto v : values)
      if (!std::isnan(v)) ++count, mean += v, squares += v * v;
    mean /= count;
    for (const auto v : values)
      if (!std::isnan(v)) spread += (v - mean) * (v - mean);
    std = std::sqrt(spread / count);
    rmse = std::sqrt(squares / count);
  }
};

// What one pass may lose, to first order in u: n roundings of the sum and, in each merge, a few of
// the means, which are |mean| / std times as large as what they are subtracted for.
void expect_close(const ErrorMoments& got, const std::vector<long double>& values) {
  const TwoPasses two(values);
  const double n = static_cast<double>(two.count), std = static_cast<double>(two.std);
  const double far = static_cast<double>(std::abs(two.mean)) / std;
  EXPECT_EQ(static_cast<double>(got.count), n);
  EXPECT_NEAR(got.mean, static_cast<double>(two.mean), n * u * static_cast<double>(two.rmse));
  EXPECT_NEAR(got.std, std, u * (n + 16.0 * far) * std);
  EXPECT_NEAR(got.rmse, static_cast<double>(two.rmse),
              u * (n + 16.0) * static_cast<double>(two.rmse));
}

TEST(Judge, OnePassKeepsTheDigitsOfTwoInLongDouble) {
  for (const int l : {0, 1, 5}) {
    SCOPED_TRACE(l);
    const auto [series, track] = trial_of(l);
    const auto errors = track_errors(series, track);
    std::vector<long double> rate, bias;
    for (std::size_t i = 0; i < samples; ++i) {  // the errors themselves are doubles, as ever
      rate.push_back(series.gyro_dps[i] - track.estimate_dps[i] - series.rate_ref_dps[i]);
      bias.push_back(track.estimate_dps[i] - series.thermal_bias_dps[i] -
                     series.random_error_dps[i]);
    }
    expect_close(errors.rate, rate);
    expect_close(errors.bias, bias);
  }
}

TEST(Judge, InnovationsAreThoseOfTheDefinitions) {
  for (const int l : {0, 7}) {
    SCOPED_TRACE(l);
    const auto [series, track] = trial_of(l);
    const auto got = track_errors(series, track).innovations;
    std::vector<long double> z;
    long double nis = 0.0, score = 0.0, magnitude = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
      const long double S = track.innovation_variance[i];
      z.push_back(track.innovation_dps[i] / std::sqrt(S));
      nis += z.back() * z.back();
      score += (std::log(2.0L * 3.14159265358979323846L * S) + z.back() * z.back()) / 2.0L;
      magnitude += (std::abs(std::log(S)) + z.back() * z.back()) / 2.0L;
    }
    const double n = samples, bound = (n + 8.0) * u;
    EXPECT_EQ(got.count, samples);
    EXPECT_NEAR(got.nis, static_cast<double>(nis) / n, bound * static_cast<double>(nis) / n);
    EXPECT_NEAR(got.log_score, static_cast<double>(score) / n,
                bound * static_cast<double>(magnitude) / n);
    long double box = 0.0;
    for (std::size_t lag = 1; lag <= Innovations::lags; ++lag) {
      long double product = 0.0;
      for (std::size_t i = lag; i < samples; ++i) product += z[i] * z[i - lag];
      const long double correlation = product / nis;
      if (lag == 1) {
        EXPECT_NEAR(got.lag_1, static_cast<double>(correlation), bound);
      }
      box += n * (n + 2.0) * correlation * correlation / (n - static_cast<double>(lag));
    }
    // Each of ten squares of correlations c, times n + 2, is off by 2 c bound (n + 2).
    EXPECT_NEAR(got.ljung_box, static_cast<double>(box),
                20.0 * bound * (n + 2.0) * std::sqrt(static_cast<double>(box) / n) + bound);
    double outer = 0.0;
    for (const auto one : z) outer += std::abs(one) > 1.2815515655446004L;
    EXPECT_DOUBLE_EQ(got.pit[0] + got.pit[9], outer / n);
  }
}

TEST(Judge, WhatIsInfiniteIsTold) {
  auto made = trial_of(0);
  made.series.gyro_dps[70] = INFINITY;
  const auto errors = track_errors(made.series, made.track);
  EXPECT_EQ(errors.rate.rmse, INFINITY);
  EXPECT_TRUE(std::isnan(errors.rate.std));
}

TEST(Judge, StepsAreCountedByStatusAndTheFirstBreakdownIsTimed) {
  const auto [series, track] = trial_of(6);
  const auto errors = track_errors(series, track);
  const auto counts = track.status_counts();
  for (std::size_t s = 0; s < counts.size(); ++s) EXPECT_EQ(errors.steps[s], counts[s]);
  std::size_t first = 0;
  while (!is_breakdown(track.status[first])) ++first;
  EXPECT_EQ(errors.first_breakdown_s, series.t_s[first] - series.t_s.front());
  EXPECT_TRUE(std::isnan(track_errors(trial_of(0).series, trial_of(0).track).first_breakdown_s));
}

}  // namespace
}  // namespace gyrostat::judge_test
