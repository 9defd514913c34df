#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/likelihood/outlier_mixture.hpp>

namespace gyrostat::gap::outlier_mixture_test {
namespace {

constexpr std::size_t samples = 50000;

/// Squares of normal values, of which the given shares have other deviations than 1.
std::vector<double> squares_of(const std::vector<OutlierMixture::Wide>& wide, std::uint64_t seed) {
  const NormalStream chance(seed, 0, "chance"), size(seed, 0, "size");
  std::vector<double> squares;
  for (std::size_t i = 0; i < samples; ++i) {
    double variance = 1.0, u = chance.uniform(i);
    for (const auto& w : wide) {
      if (u >= 0.0 && u < w.share) variance = w.variance;
      u -= w.share;
    }
    const double e = size.normal(i);
    squares.push_back(variance * e * e);
  }
  return squares;
}

/// Written out, sample by sample; beyond one normal law's.
double gain_of(const OutlierMixture& m, const std::vector<double>& squares) {
  const auto density = [](double square, double variance) {
    return std::exp(-0.5 * square / variance) / std::sqrt(variance);
  };
  double gain = 0.0, sum = 0.0;
  for (const double s : squares) {
    double all = (1.0 - m.share()) * density(s, m.narrow);
    for (const auto& w : m.wide) all += w.share * density(s, w.variance);
    gain += std::log(all);
    sum += s;
  }
  const auto n = static_cast<double>(squares.size());
  return gain + 0.5 * n * (std::log(sum / n) + 1.0);
}

/// The likeliest laws are likelier than the true one, by half a chi-squared of five degrees of
/// freedom: above 20 in one of 1e7. Gathering alike squares may cost a nat.
TEST(OutlierMixture, OfTwoWideOnesIsTheLikeliest) {
  const OutlierMixture truth{.narrow = 1.0, .wide = {{0.3, 16.0}, {0.001, 2500.0}}};
  const auto squares = squares_of(truth.wide, 1);
  const auto found = outlier_mixture(squares, 1.3);
  ASSERT_EQ(found.wide.size(), 2);
  const double likelier = gain_of(found, squares) - gain_of(truth, squares);
  EXPECT_GT(likelier, -1.0);
  EXPECT_LT(likelier, 20.0);
  // Two values more than of one wide law cost half a logarithm of the samples each.
  EXPECT_NEAR(found.gain + std::log(static_cast<double>(samples)), gain_of(found, squares), 1.0);
}

/// Half the samples' deviations are known to 1 / sqrt(n), less than 5 of which are allowed here;
/// the share to about sqrt(share / n).
TEST(OutlierMixture, OfOneWideOneHasNoSecond) {
  const auto found = outlier_mixture(squares_of({{0.01, 36.0}}, 2), 1.0);
  ASSERT_EQ(found.wide.size(), 1);
  EXPECT_EQ(found.wide[0].size, 0.0);
  EXPECT_NEAR(found.narrow, 1.0, 5.0 * std::sqrt(2.0 / samples));
  EXPECT_NEAR(found.wide[0].share, 0.01, 5.0 * 1.5 * std::sqrt(0.01 / samples));
}

/// Student's law of three degrees of freedom, whose tails go on as a power: as many normal ones as
/// its decades have samples for are as likely as itself, to what a value costs.
TEST(OutlierMixture, OfTailsThatGoOnHasEnough) {
  const NormalStream size(4, 0, "size");
  constexpr double degrees = 3.0;
  std::vector<double> squares;
  double likelihood = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    double chi_squared = 0.0;
    for (std::uint64_t k = 1; k < 4; ++k) chi_squared += std::pow(size.normal(4 * i + k), 2);
    squares.push_back(std::pow(size.normal(4 * i), 2) * degrees / chi_squared);
    sum += squares.back();
    likelihood -= 0.5 * (degrees + 1.0) * std::log1p(squares.back() / degrees);
  }
  constexpr auto n = static_cast<double>(samples);
  const double normalised = std::lgamma(0.5 * (degrees + 1.0)) - std::lgamma(0.5 * degrees) -
                            0.5 * std::log(0.5 * degrees);
  const double gain_of_student = likelihood + n * normalised + 0.5 * n * (std::log(sum / n) + 1.0);
  const auto found = outlier_mixture(squares, 1.0);
  EXPECT_GE(found.wide.size(), 3);
  EXPECT_NEAR(gain_of(found, squares), gain_of_student, std::log(n));
}

/// What chance gives three values more: above 12 nats in one of 1e4.
TEST(OutlierMixture, OfNormalValuesGainsNothing) {
  EXPECT_LT(outlier_mixture(squares_of({}, 3), 1.0).gain, 12.0);
}

}  // namespace
}  // namespace gyrostat::gap::outlier_mixture_test
