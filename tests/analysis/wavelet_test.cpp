#include <gyrostat/analysis/spectra/wavelet.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::wavelet_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array wavelets = {Wavelet::Haar, Wavelet::Daubechies4, Wavelet::LeastAsymmetric8};
constexpr std::array transforms = {Transform::Decimated, Transform::Stationary};

WaveletCoefficients transform(Transform kind, std::span<const double> signal, Wavelet wavelet,
                              std::size_t levels) {
  return kind == Transform::Decimated ? dwt(signal, wavelet, levels)
                                      : modwt(signal, wavelet, levels);
}

std::vector<double> white(std::size_t n, std::uint32_t trial = 0) {
  std::vector<double> signal(n);
  NormalStream(1, trial, "wavelet test").fill(0, signal);
  return signal;
}

std::vector<double> random_walk(std::size_t n) {
  auto signal = white(n);
  std::partial_sum(signal.begin(), signal.end(), signal.begin());
  return signal;
}

double energy(std::span<const double> values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

double energy(const WaveletCoefficients& coefficients) {
  double sum = energy(coefficients.smooth);
  for (const auto& detail : coefficients.detail) sum += energy(detail);
  return sum;
}

/// All coefficients in one column: details from the finest, then the smooth.
Eigen::VectorXd column(const WaveletCoefficients& coefficients) {
  std::vector<double> all;
  for (const auto& detail : coefficients.detail)
    all.insert(all.end(), detail.begin(), detail.end());
  all.insert(all.end(), coefficients.smooth.begin(), coefficients.smooth.end());
  return Eigen::VectorXd::Map(all.data(), std::ssize(all));
}

Eigen::MatrixXd matrix(Transform kind, Wavelet wavelet, std::size_t n, std::size_t levels) {
  Eigen::MatrixXd out;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> impulse(n, 0.0);
    impulse[i] = 1.0;
    const Eigen::VectorXd response = column(transform(kind, impulse, wavelet, levels));
    out.conservativeResize(response.size(), out.cols() + 1);
    out.col(out.cols() - 1) = response;
  }
  return out;
}

void expect_near(std::span<const double> a, std::span<const double> b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(WaveletFilter, IsOrthonormalToItsEvenShiftsAndToTheScalingFilter) {
  for (const Wavelet wavelet : wavelets) {
    const auto g = scaling_filter(wavelet);
    const auto h = wavelet_filter(wavelet);
    for (std::size_t shift = 0; shift < g.size(); shift += 2) {
      double gg = shift == 0 ? -1.0 : 0.0, hh = gg, gh = 0.0, hg = 0.0;
      for (std::size_t l = 0; l + shift < g.size(); ++l) {
        gg += g[l] * g[l + shift];
        hh += h[l] * h[l + shift];
        gh += g[l] * h[l + shift];
        hg += h[l] * g[l + shift];
      }
      for (const double residual : {gg, hh, gh, hg}) EXPECT_NEAR(residual, 0.0, 3e-16);
    }
    EXPECT_NEAR(std::accumulate(g.begin(), g.end(), 0.0), std::sqrt(2.0), 5e-16);
  }
}

TEST(WaveletFilter, HasAsManyVanishingMomentsAsHalfItsWidth) {
  for (const Wavelet wavelet : wavelets) {
    const auto h = wavelet_filter(wavelet);
    const auto moment = [&](int order) {
      double sum = 0.0;
      for (std::size_t l = 0; l < h.size(); ++l) sum += h[l] * std::pow(l, order);
      return sum;
    };
    const int vanishing = static_cast<int>(h.size()) / 2;
    for (int order = 0; order < vanishing; ++order)
      EXPECT_NEAR(moment(order), 0.0, 1e-16 * std::pow(h.size(), order + 1)) << order;
    EXPECT_GT(std::abs(moment(vanishing)), 0.5);
  }
}

// Daubechies 1992, table 6.1; Percival & Walden, p. 109, whose LA(8) is good to 4e-13.
TEST(WaveletFilter, IsThePublishedOne) {
  expect_near(
      scaling_filter(Wavelet::Daubechies4),
      std::vector{0.4829629131445341, 0.8365163037378077, 0.2241438680420134, -0.1294095225512603},
      1e-15);
  expect_near(
      scaling_filter(Wavelet::LeastAsymmetric8),
      std::vector{-0.0757657147893407, -0.0296355276459541, 0.4976186676324578, 0.8037387518052163,
                  0.2978577956055422, -0.0992195435769354, -0.0126039672622612, 0.0322231006040713},
      4e-13);
}

TEST(Wavelet, ReconstructsPerfectlyAtAnyLength) {
  for (const Wavelet wavelet : wavelets)
    for (const Transform kind : transforms)
      for (const std::size_t n : {2, 3, 7, 64, 96, 1000, 1001, 4096, 6000}) {
        const auto signal = white(n);
        for (std::size_t levels = 1; (std::size_t{1} << levels) <= n; ++levels)
          expect_near(inverse(transform(kind, signal, wavelet, levels)), signal, 1e-12);
      }
}

TEST(Wavelet, ReconstructsARandomWalkToTheLastDigits) {
  const auto walk = random_walk(100'000);
  const auto [least, greatest] = std::minmax_element(walk.begin(), walk.end());
  for (const Wavelet wavelet : wavelets)
    for (const Transform kind : transforms)
      expect_near(inverse(transform(kind, walk, wavelet, 12)), walk, 1e-14 * (*greatest - *least));
}

TEST(Wavelet, PreservesEnergy) {
  for (const Wavelet wavelet : wavelets) {
    for (const std::size_t n : {64, 96, 4096}) {
      const auto signal = white(n);
      EXPECT_NEAR(energy(dwt(signal, wavelet, 5)) / energy(signal), 1.0, 1e-13);
    }
    for (const std::size_t n : {64, 97, 4001}) {
      const auto signal = white(n);
      EXPECT_NEAR(energy(modwt(signal, wavelet, 5)) / energy(signal), 1.0, 1e-13);
    }
    const auto odd = white(1001);
    EXPECT_NEAR(energy(dwt(odd, wavelet, 5)) / energy(reflected(odd, 1024)), 1.0, 1e-13);
  }
}

// At 8 samples the filters are wider than the signal and wrap around it.
TEST(Wavelet, DecimatedMatrixIsOrthogonal) {
  for (const Wavelet wavelet : wavelets)
    for (const std::size_t n : {8, 24, 64}) {
      const auto w = matrix(Transform::Decimated, wavelet, n, 3);
      ASSERT_EQ(w.rows(), w.cols());
      const auto identity = Eigen::MatrixXd::Identity(w.rows(), w.cols());
      EXPECT_LT((w * w.transpose() - identity).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_LT((w.transpose() * w - identity).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(Wavelet, StationaryMatrixIsATightFrame) {
  for (const Wavelet wavelet : wavelets)
    for (const std::size_t n : {8, 15, 64}) {
      const auto w = matrix(Transform::Stationary, wavelet, n, 3);
      ASSERT_EQ(w.rows(), 4 * w.cols());
      const auto identity = Eigen::MatrixXd::Identity(w.cols(), w.cols());
      EXPECT_LT((w.transpose() * w - identity).cwiseAbs().maxCoeff(), 1e-14);
    }
}

/// The filter from the signal straight to level `level`, by convolution of the filters of all
/// levels up to it, spread out by 2^(level - 1) (Percival & Walden ch. 4).
std::vector<double> equivalent_filter(Wavelet wavelet, std::size_t level) {
  std::vector<double> out = {1.0};
  for (std::size_t k = 1; k <= level; ++k) {
    const auto scaling = scaling_filter(wavelet);
    const auto next =
        k == level ? wavelet_filter(wavelet) : std::vector<double>(scaling.begin(), scaling.end());
    const std::size_t spread = std::size_t{1} << (k - 1);
    std::vector<double> product(out.size() + spread * (next.size() - 1), 0.0);
    for (std::size_t i = 0; i < out.size(); ++i)
      for (std::size_t l = 0; l < next.size(); ++l) product[i + spread * l] += out[i] * next[l];
    out = product;
  }
  return out;
}

TEST(Wavelet, IsTheConvolutionWithTheEquivalentFilters) {
  const std::size_t n = 96;
  const auto signal = white(n);
  for (const Wavelet wavelet : wavelets) {
    const auto decimated = dwt(signal, wavelet, 4);
    const auto stationary = modwt(signal, wavelet, 4);
    for (std::size_t level = 1; level <= 4; ++level) {
      const auto filter = equivalent_filter(wavelet, level);
      const auto convolution = [&](std::size_t t) {
        double sum = 0.0;
        for (std::size_t l = 0; l < filter.size(); ++l)
          sum += filter[l] * signal[(t + 16 * n - l) % n];
        return sum;
      };
      const std::size_t step = std::size_t{1} << level;
      for (std::size_t t = 0; t < n / step; ++t)
        EXPECT_NEAR(decimated.detail[level - 1][t], convolution(step * t + step - 1), 1e-13);
      for (std::size_t t = 0; t < n; ++t)
        EXPECT_NEAR(stationary.detail[level - 1][t], convolution(t) / std::sqrt(step), 1e-13);
    }
  }
}

TEST(Wavelet, OfAPolynomialBelowItsMomentsIsZeroAwayFromTheEnds) {
  for (const Wavelet wavelet : wavelets) {
    const int moments = static_cast<int>(scaling_filter(wavelet).size() / 2);
    std::vector<double> signal(512);
    for (std::size_t i = 0; i < signal.size(); ++i)
      signal[i] = std::pow(static_cast<double>(i) / 512.0, moments - 1);
    const auto stationary = modwt(signal, wavelet, 4);
    for (std::size_t level = 1; level <= 4; ++level)
      for (std::size_t t = equivalent_filter(wavelet, level).size() - 1; t < signal.size(); ++t)
        EXPECT_NEAR(stationary.detail[level - 1][t], 0.0, 1e-14);
  }
}

TEST(Wavelet, AShiftOfTheSignalShiftsTheStationaryCoefficients) {
  const auto signal = white(301);
  auto shifted = signal;
  std::rotate(shifted.begin(), shifted.begin() + 47, shifted.end());
  for (const Wavelet wavelet : wavelets) {
    auto expected = modwt(signal, wavelet, 5);
    const auto coefficients = modwt(shifted, wavelet, 5);
    for (std::size_t j = 0; j < 5; ++j) {
      auto& detail = expected.detail[j];
      std::rotate(detail.begin(), detail.begin() + 47, detail.end());
      EXPECT_EQ(coefficients.detail[j], detail);
    }
    std::rotate(expected.smooth.begin(), expected.smooth.begin() + 47, expected.smooth.end());
    EXPECT_EQ(coefficients.smooth, expected.smooth);
  }
}

TEST(Wavelet, IsLinear) {
  const auto a = white(100, 1), b = white(100, 2);
  std::vector<double> sum(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] = 3.0 * a[i] - 0.5 * b[i];
  for (const Wavelet wavelet : wavelets)
    for (const Transform kind : transforms) {
      const Eigen::VectorXd expected = 3.0 * column(transform(kind, a, wavelet, 4)) -
                                       0.5 * column(transform(kind, b, wavelet, 4));
      const Eigen::VectorXd difference = column(transform(kind, sum, wavelet, 4)) - expected;
      EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-13);
    }
}

// Percival & Walden ch. 8: the Allan variance is twice the Haar wavelet variance.
TEST(Wavelet, HaarVarianceIsHalfTheAllanVariance) {
  const auto signal = random_walk(1000);
  const auto coefficients = modwt(signal, Wavelet::Haar, 6);
  for (std::size_t j = 0; j < 6; ++j) {
    const std::size_t cluster = std::size_t{1} << j;
    const auto inside = std::span(coefficients.detail[j]).subspan(2 * cluster - 1);
    const double variance = energy(inside) / static_cast<double>(inside.size());
    const auto point = overlapping_allan_deviation(signal, 1.0, std::array{cluster}).front();
    EXPECT_NEAR(2.0 * variance / (point.deviation * point.deviation), 1.0, 1e-11);
  }
}

// 2 x 6 chi-square variables at 4.5 standard errors: 1 false failure in 12000 runs.
TEST(Wavelet, OfWhiteNoiseHasTheStatedStandardDeviations) {
  const auto signal = white(65'536);
  for (std::size_t level = 1; level <= 6; ++level) {
    const auto decimated = dwt(signal, Wavelet::LeastAsymmetric8, 6).detail[level - 1];
    const double count = static_cast<double>(decimated.size());
    EXPECT_NEAR(energy(decimated) / count, 1.0, 4.5 * std::sqrt(2.0 / count));
    const auto stationary = modwt(signal, Wavelet::LeastAsymmetric8, 6).detail[level - 1];
    EXPECT_NEAR(energy(stationary) / 65'536.0 * std::exp2(level), 1.0,
                4.5 * std::sqrt(2.0 / count));
  }
}

TEST(Wavelet, MostLevelsIsWhatTheWidestFilterLeaves) {
  for (const Wavelet wavelet : wavelets)
    for (const std::size_t n : {1, 2, 7, 8, 21, 22, 1000, 1024}) {
      const std::size_t levels = most_levels(wavelet, n);
      EXPECT_TRUE(levels == 0 || equivalent_filter(wavelet, levels).size() <= n) << n;
      EXPECT_GT(equivalent_filter(wavelet, levels + 1).size(), n);
    }
}

TEST(Wavelet, ReflectionTurnsAtTheHalfSample) {
  EXPECT_EQ(reflected(std::vector{1.0, 2.0, 3.0}, 8),
            (std::vector{1.0, 2.0, 3.0, 3.0, 2.0, 1.0, 1.0, 2.0}));
  EXPECT_EQ(reflected(std::vector{4.0}, 3), (std::vector{4.0, 4.0, 4.0}));
}

TEST(Wavelet, RefusesWhatItCannotUse) {
  auto signal = white(100);
  for (const Transform kind : transforms) {
    EXPECT_THAT([&] { transform(kind, signal, Wavelet::Haar, 7); },
                ThrowsMessage<InputError>(HasSubstr("7 is outside [1, 6] for 100 samples")));
    EXPECT_THROW(transform(kind, signal, Wavelet::Haar, 0), InputError);
    EXPECT_THROW(transform(kind, {}, Wavelet::Haar, 1), InputError);
  }
  for (const double missing : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    signal[17] = missing;
    for (const Transform kind : transforms)
      EXPECT_THAT([&] { transform(kind, signal, Wavelet::Haar, 3); },
                  ThrowsMessage<InputError>(HasSubstr("signal[17]: is missing or not finite")));
  }
}

}  // namespace
}  // namespace gyrostat::wavelet_test
