#include <gyrostat/analysis/spectra/shrinkage.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::shrinkage_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array wavelets = {Wavelet::Haar, Wavelet::Daubechies4, Wavelet::LeastAsymmetric8};
constexpr std::array transforms = {Transform::Decimated, Transform::Stationary};
constexpr std::array rules = {ThresholdRule::Soft, ThresholdRule::Hard};

std::vector<double> white(std::size_t n, std::uint32_t trial = 0, double std = 1.0) {
  std::vector<double> rate(n);
  NormalStream(1, trial, "shrinkage test").fill(0, rate);
  for (double& y : rate) y *= std;
  return rate;
}

std::vector<double> sum(std::vector<double> a, std::span<const double> b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

std::vector<double> step(std::size_t n, std::size_t at, double height) {
  std::vector<double> rate(n, 0.0);
  std::fill(rate.begin() + static_cast<std::ptrdiff_t>(at), rate.end(), height);
  return rate;
}

double mean_square_error(std::span<const double> a, std::span<const double> b) {
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return square / static_cast<double>(a.size());
}

struct Mean {
  double value, standard_error;
};

template <class Draw>
Mean mean_over(std::uint32_t trials, const Draw& draw) {
  double total = 0.0, squares = 0.0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const double x = draw(trial);
    total += x;
    squares += x * x;
  }
  const double mean = total / trials;
  return {mean, std::sqrt((squares / trials - mean * mean) / trials)};
}

TEST(Thresholded, SoftAndHardAreWhatTheirNamesSay) {
  for (const double w : {-3.0, -1.5, -0.2, 0.0, 0.7, 1.0, 1.5, 40.0}) {
    const double soft = thresholded(w, 1.0, ThresholdRule::Soft);
    const double hard = thresholded(w, 1.0, ThresholdRule::Hard);
    EXPECT_EQ(soft, std::copysign(std::max(std::abs(w) - 1.0, 0.0), soft == 0.0 ? 0.0 : w));
    EXPECT_EQ(hard, std::abs(w) > 1.0 ? w : 0.0);
    EXPECT_EQ(thresholded(hard, 1.0, ThresholdRule::Hard), hard);
    for (const ThresholdRule rule : rules) {
      EXPECT_EQ(thresholded(w, 0.0, rule), w);
      EXPECT_EQ(thresholded(-w, 1.0, rule), -thresholded(w, 1.0, rule));
    }
  }
}

TEST(Thresholded, SoftBringsNoTwoCoefficientsFurtherApart) {
  for (double a = -3.0; a < 3.0; a += 0.17)
    for (double b = -3.0; b < 3.0; b += 0.13)
      EXPECT_LE(std::abs(thresholded(a, 1.0, ThresholdRule::Soft) -
                         thresholded(b, 1.0, ThresholdRule::Soft)),
                std::abs(a - b) + 1e-15);
}

// The standard error of a median absolute deviation of m normals is 1.166 / sqrt(m). Twelve
// estimates at 4.5 of them: 1 false failure in 12000 runs.
TEST(NoiseStd, IsThatOfTheNoiseUnderASignal) {
  const std::size_t n = 16'384;
  auto signal = step(n, 5000, 100.0);
  for (std::size_t i = 0; i < n; ++i) signal[i] += 30.0 * std::sin(0.001 * static_cast<double>(i));
  const double tolerance = 4.5 * 1.166 / std::sqrt(n / 2.0);
  for (const auto& clean : {std::vector<double>(n, 0.0), signal})
    for (const Wavelet wavelet : wavelets) {
      const auto rate = sum(clean, white(n, 7, 0.3));
      EXPECT_NEAR(noise_std(dwt(rate, wavelet, 3)) / 0.3, 1.0, tolerance);
      EXPECT_NEAR(noise_std(modwt(rate, wavelet, 3)) / 0.3, 1.0, tolerance);
    }
}

TEST(UniversalThreshold, CountsTheCoefficientsToBeJudged) {
  const auto noise = white(1000);
  EXPECT_DOUBLE_EQ(universal_threshold(dwt(noise, Wavelet::Haar, 5)),
                   std::sqrt(2.0 * std::log(1000.0)));
  EXPECT_DOUBLE_EQ(universal_threshold(modwt(noise, Wavelet::Haar, 5)),
                   std::sqrt(2.0 * std::log(5000.0)));
}

TEST(Shrink, ScalesTheThresholdWithTheNoiseOfEachLevel) {
  auto coefficients = modwt(white(64), Wavelet::Haar, 3);
  const auto before = coefficients;
  shrink(coefficients, 1.0, ThresholdRule::Hard);
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t t = 0; t < 64; ++t) {
      const double w = before.detail[j][t];
      EXPECT_EQ(coefficients.detail[j][t], w * w * std::exp2(j + 1) > 1.0 ? w : 0.0);
    }
  EXPECT_EQ(coefficients.smooth, before.smooth);
}

// Coifman & Donoho 1995: cycle spinning.
TEST(Shrink, StationaryIsTheMeanOfDecimatedOverAllShifts) {
  const std::size_t n = 64, shifts = 8;
  const auto rate = sum(step(n, 21, 5.0), white(n));
  for (const Wavelet wavelet : wavelets)
    for (const ThresholdRule rule : rules) {
      auto stationary = modwt(rate, wavelet, 3);
      shrink(stationary, 1.3, rule);
      std::vector<double> mean(n, 0.0);
      for (std::size_t shift = 0; shift < shifts; ++shift) {
        auto turned = rate;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(shift),
                    turned.end());
        auto decimated = dwt(turned, wavelet, 3);
        shrink(decimated, 1.3, rule);
        const auto denoised = inverse(decimated);
        for (std::size_t i = 0; i < n; ++i) mean[(i + shift) % n] += denoised[i] / shifts;
      }
      EXPECT_LT(mean_square_error(inverse(stationary), mean), 1e-28);
    }
}

/// The rate when no detail is kept.
std::vector<double> smooth_only(std::span<const double> rate, const ShrinkageOptions& options) {
  const std::size_t levels = most_levels(options.wavelet, rate.size());
  const std::size_t block =
      options.transform == Transform::Decimated ? std::size_t{1} << levels : 1;
  const std::size_t half = (rate.size() + block - 1) / block * block;
  const auto mirrored = reflected(reflected(rate, half), 2 * half);
  auto coefficients = options.transform == Transform::Decimated
                          ? dwt(mirrored, options.wavelet, levels)
                          : modwt(mirrored, options.wavelet, levels);
  for (auto& detail : coefficients.detail) std::fill(detail.begin(), detail.end(), 0.0);
  coefficients.samples = rate.size();
  return inverse(coefficients);
}

// 1020 independent details; 2000 trials, 4.5 standard errors.
TEST(Shrink, KeepsADetailOfWhiteNoiseAsOftenAsTheNormalTailSays) {
  const auto [share, error] = mean_over(2000, [](std::uint32_t trial) {
    auto coefficients = dwt(white(1024, trial), Wavelet::LeastAsymmetric8, 8);
    shrink(coefficients, universal_threshold(coefficients), ThresholdRule::Hard);
    double kept = 0.0;
    for (const auto& detail : coefficients.detail)
      for (const double w : detail) kept += std::abs(w);
    return kept > 0.0 ? 1.0 : 0.0;
  });
  const double tail = std::erfc(std::sqrt(std::log(1024.0)));
  EXPECT_NEAR(share, 1.0 - std::pow(1.0 - tail, 1020), 4.5 * error);
  EXPECT_LT(share, 1.0 / std::sqrt(std::numbers::pi * std::log(1024.0)));
}

// Measured with 600 trials: 0.21 to 0.24 decimated, where the promise is 1 / sqrt(pi log 1000) =
// 0.215 for a known standard deviation; 0.12 to 0.14 stationary, whose coefficients overlap.
TEST(ShrinkRate, OfWhiteNoiseLeavesNothingAsOftenAsTheThresholdPromises) {
  for (const Wavelet wavelet : {Wavelet::Haar, Wavelet::LeastAsymmetric8})
    for (const Transform transform : transforms) {
      const ShrinkageOptions options{.wavelet = wavelet, .transform = transform};
      const auto [share, error] = mean_over(300, [&](std::uint32_t trial) {
        const auto rate = white(1000, trial);
        const auto left = mean_square_error(shrink_rate(rate, options).rate,  //
                                            smooth_only(rate, options));
        return left > 1e-24 ? 1.0 : 0.0;
      });
      EXPECT_LT(share, 0.24 + 4.5 * error);
    }
}

TEST(ShrinkRate, OfAConstantOrARampAloneIsItself) {
  for (const Transform transform : transforms)
    for (const ThresholdRule rule : rules)
      for (const std::size_t n : {100, 1000, 1024, 1001}) {
        std::vector<double> constant(n, 0.75), ramp(n);
        for (std::size_t i = 0; i < n; ++i) ramp[i] = 2.0 - 1e-3 * static_cast<double>(i);
        const ShrinkageOptions options{.transform = transform, .rule = rule};
        EXPECT_LT(mean_square_error(shrink_rate(constant, options).rate, constant), 1e-26);
        EXPECT_LT(mean_square_error(shrink_rate(ramp, options).rate, ramp), 1e-26);
      }
}

double slope(std::span<const double> rate) {
  const double middle = 0.5 * static_cast<double>(rate.size() - 1);
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    product += x * rate[i];
    square += x * x;
  }
  return product / square;
}

// Measured: 0.0023 to 0.0026 of the noise is left, the slope is kept to 0.2 %. The least-squares
// slope of 4000 samples has a standard error of 1.4 % in one trial, 0.2 % over 50.
TEST(ShrinkRate, OfARampInNoiseIsTheRamp) {
  const std::size_t n = 4000;
  std::vector<double> ramp(n);
  for (std::size_t i = 0; i < n; ++i) ramp[i] = 1e-3 * static_cast<double>(i);
  for (const Transform transform : transforms)
    for (const ThresholdRule rule : rules) {
      const ShrinkageOptions options{.transform = transform, .rule = rule};
      double square = 0.0;
      const auto kept = mean_over(50, [&](std::uint32_t trial) {
        const auto shrunk = shrink_rate(sum(ramp, white(n, trial)), options).rate;
        square += mean_square_error(shrunk, ramp) / 50.0;
        return slope(shrunk) / 1e-3;
      });
      EXPECT_NEAR(kept.value, 1.0, 4.5 * 0.002);
      EXPECT_LT(square, 0.005);
    }
}

/// Mean square error of soft thresholding of theta + z, z ~ N(0, 1) (Donoho & Johnstone 1994).
double soft_risk(double theta, double t) {
  const auto density = [](double x) {
    return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
  };
  const auto below = [](double x) { return 0.5 * std::erfc(-x * std::numbers::sqrt2 / 2.0); };
  return 1.0 + t * t + (theta * theta - t * t - 1.0) * (below(t - theta) - below(-t - theta)) -
         (t - theta) * density(t + theta) - (t + theta) * density(t - theta);
}

/// n, mirrored, is a whole number of blocks and no Haar coefficient straddles a fold.
const std::vector<double> clean_step = step(1024, 341, 3.0);

TEST(Shrink, OfAStepInNoiseHasTheRiskOfTheory) {
  const double n = 1024.0;
  const auto exact = dwt(clean_step, Wavelet::Haar, 10);
  const double t = universal_threshold(exact);
  double risk = 1.0, ideal = 1.0;
  for (const auto& detail : exact.detail)
    for (const double theta : detail) {
      risk += soft_risk(theta, t);
      ideal += std::min(theta * theta, 1.0);
    }
  const auto measured = mean_over(300, [&](std::uint32_t trial) {
    auto coefficients = dwt(sum(clean_step, white(1024, trial)), Wavelet::Haar, 10);
    shrink(coefficients, t, ThresholdRule::Soft);
    return mean_square_error(inverse(coefficients), clean_step);
  });
  EXPECT_NEAR(measured.value, risk / n, 4.5 * measured.standard_error);
  // Donoho & Johnstone 1994, theorem 1.
  EXPECT_LT(measured.value, (2.0 * std::log(n) + 1.0) * (1.0 + ideal) / n);
}

double step_error(const ShrinkageOptions& options, std::uint32_t trial) {
  return mean_square_error(shrink_rate(sum(clean_step, white(1024, trial)), options).rate,
                           clean_step);
}

// Measured with 100 trials: 0.011 to 0.111 of the noise; the theorem's bound for Haar is 0.174.
TEST(ShrinkRate, OfAStepInNoiseIsBelowTheBoundAndFarBelowTheNoise) {
  for (const Wavelet wavelet : wavelets)
    for (const Transform transform : transforms)
      for (const ThresholdRule rule : rules) {
        const auto error = mean_over(30, [&](std::uint32_t trial) {
          return step_error({wavelet, transform, rule}, trial);
        });
        EXPECT_LT(error.value + 4.5 * error.standard_error, 0.174);
      }
}

// Paired. Measured with 100 trials: half the error of decimated hard, and less than soft.
TEST(ShrinkRate, StationaryHardIsTheBestOfTheFourOnAStep) {
  for (const Wavelet wavelet : wavelets)
    for (const ShrinkageOptions other :
         {ShrinkageOptions{wavelet, Transform::Decimated, ThresholdRule::Soft},
          ShrinkageOptions{wavelet, Transform::Decimated, ThresholdRule::Hard},
          ShrinkageOptions{wavelet, Transform::Stationary, ThresholdRule::Soft}}) {
      const auto gain = mean_over(60, [&](std::uint32_t trial) {
        return step_error(other, trial) - step_error({.wavelet = wavelet}, trial);
      });
      EXPECT_GT(gain.value, 3.0 * gain.standard_error);
    }
}

TEST(ShrinkRate, FollowsTheUnitAndTheMean) {
  const auto rate = sum(step(1001, 341, 5.0), white(1001));
  auto other = rate;
  for (double& y : other) y = 1000.0 - 4.0 * y;
  for (const Transform transform : transforms) {
    const ShrinkageOptions options{.transform = transform};
    const auto expected = shrink_rate(rate, options);
    const auto shrunk = shrink_rate(other, options);
    EXPECT_NEAR(shrunk.noise_std, 4.0 * expected.noise_std, 1e-11);
    EXPECT_NEAR(shrunk.threshold, 4.0 * expected.threshold, 1e-11);
    EXPECT_EQ(shrunk.levels, 7U);
    ASSERT_EQ(shrunk.rate.size(), rate.size());
    for (std::size_t i = 0; i < rate.size(); ++i)
      EXPECT_NEAR(shrunk.rate[i], 1000.0 - 4.0 * expected.rate[i], 1e-10);
  }
}

TEST(ShrinkRate, StationaryHaarDoesNotKnowTheDirectionOfTime) {
  auto rate = sum(step(1001, 341, 5.0), white(1001));
  for (const ThresholdRule rule : rules) {
    const ShrinkageOptions options{.wavelet = Wavelet::Haar, .rule = rule};
    auto forwards = shrink_rate(rate, options).rate;
    std::reverse(rate.begin(), rate.end());
    std::reverse(forwards.begin(), forwards.end());
    EXPECT_LT(mean_square_error(shrink_rate(rate, options).rate, forwards), 1e-24);
  }
}

TEST(ShrinkRate, ARateRoundedCoarserThanItsNoiseIsLeftAlone) {
  auto rate = white(1000, 0, 0.1);
  for (double& y : rate) y = std::round(y / 0.5) * 0.5;
  const auto shrunk = shrink_rate(rate);
  EXPECT_EQ(shrunk.noise_std, 0.0);
  EXPECT_LT(mean_square_error(shrunk.rate, rate), 1e-28);
}

TEST(ShrinkRate, RefusesWhatItCannotUse) {
  auto rate = white(100);
  EXPECT_THAT([&] { shrink_rate(rate, {.levels = 4}); },
              ThrowsMessage<InputError>(HasSubstr("4 is outside [1, 3] for 100 samples")));
  EXPECT_THAT([] { shrink_rate(white(7)); },
              ThrowsMessage<InputError>(HasSubstr("7 samples; at least 8 are needed")));
  EXPECT_THROW(shrink_rate({}), InputError);
  for (const double missing : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    rate[17] = missing;
    for (const Transform transform : transforms)
      EXPECT_THAT([&] { shrink_rate(rate, {.transform = transform}); },
                  ThrowsMessage<InputError>(HasSubstr("[17]: is missing or not finite")));
  }
}

}  // namespace
}  // namespace gyrostat::shrinkage_test
