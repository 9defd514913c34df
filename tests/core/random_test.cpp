#include <gyrostat/core/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Random123/philox.h>
#include <gtest/gtest.h>

namespace gyrostat::random_test {
namespace {

constexpr std::size_t draws = 400'000;

std::vector<double> normals(std::uint64_t seed, std::uint32_t trial, std::string_view stream,
                            std::size_t count = draws) {
  std::vector<double> out(count);
  NormalStream(seed, trial, stream).fill(0, out);
  return out;
}

/// Mean over the draws of `of(draw)`.
template <class Of>
double mean(const std::vector<double>& values, const Of& of) {
  double sum = 0.0;
  for (const double v : values) sum += of(v);
  return sum / static_cast<double>(values.size());
}

/// sqrt(n) times the sample correlation of two independent normals: itself standard normal.
double scaled_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / std::sqrt(static_cast<double>(a.size()));
}

std::uint32_t word_of(double uniform) {
  return static_cast<std::uint32_t>(std::ldexp(uniform, 32) - 0.5);
}

std::array<double, 4> box_muller(const std::array<std::uint32_t, 4>& w) {
  const auto unit = [](std::uint32_t word) { return (word + 0.5) / 4294967296.0; };
  std::array<double, 4> out{};
  for (std::size_t i = 0; i < 4; i += 2) {
    const long double radius = std::sqrt(-2.0L * std::log(static_cast<long double>(unit(w[i]))));
    const long double angle = 2.0L * std::numbers::pi_v<long double> * unit(w[i + 1]);
    out[i] = static_cast<double>(radius * std::cos(angle));
    out[i + 1] = static_cast<double>(radius * std::sin(angle));
  }
  return out;
}

/// FNV-1a of these eight bytes is 0 (Noll, "FNV hash", zero-hash challenge), so seed 0, trial 0 of
/// this stream is Philox at counter 0 under key 0.
constexpr std::string_view zero_hash = "\xd5\x6b\xb9\x53\x42\x87\x08\x36";

/// Random123's kat_vectors: "philox4x32 10 00000000 ... -> 6627e8d5 e169c58d bc57ac4c 9b00dbd8".
constexpr std::array<std::uint32_t, 4> zero_answer = {0x6627e8d5, 0xe169c58d, 0xbc57ac4c,
                                                      0x9b00dbd8};

TEST(NormalStream, UniformsGiveThePublishedPhiloxWordsAtCounterZero) {
  const NormalStream stream(0, 0, zero_hash);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(word_of(stream.uniform(i)), zero_answer[i]) << i;
}

TEST(NormalStream, NormalsAreBoxMullerOfThePublishedWords) {
  const auto expected = box_muller(zero_answer);
  const NormalStream stream(0, 0, zero_hash);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(stream.normal(i), expected[i]) << i;
}

/// kat_vectors of Random123 1.14 for philox4x32 with 10 rounds: ones, and the digits of pi.
TEST(NormalStream, TheGeneratorUnderneathPassesItsKnownAnswers) {
  using Philox = r123::Philox4x32;
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(Philox{}({{ones, ones, ones, ones}}, {{ones, ones}}),
            (Philox::ctr_type{{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}}));
  EXPECT_EQ(
      Philox{}({{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}}, {{0xa4093822, 0x299f31d0}}),
      (Philox::ctr_type{{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}}));
}

TEST(NormalStream, TheAddressIsBlockTrialAndStreamUnderTheSeedAsKey) {
  const std::uint64_t seed = 0x0123456789abcdef;
  const std::uint32_t trial = 4'000'000'001;
  const std::string name = "random_error";
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  const auto low = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
  const NormalStream stream(seed, trial, name);
  for (const std::uint64_t block : {0U, 1U, 77U, 1'000'000U}) {
    const auto words = r123::Philox4x32{}({{low(block), trial, low(hash), low(hash >> 32U)}},
                                          {{low(seed), low(seed >> 32U)}});
    const auto expected = box_muller({words[0], words[1], words[2], words[3]});
    for (std::size_t lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(word_of(stream.uniform(4 * block + lane)), words[lane]);
      EXPECT_DOUBLE_EQ(stream.normal(4 * block + lane), expected[lane]);
    }
  }
}

TEST(NormalStream, FillEqualsNormalFromAnyOffset) {
  const NormalStream stream(42, 7, "offsets");
  for (std::uint64_t first = 0; first < 9; ++first)
    for (std::size_t count = 0; count < 11; ++count) {
      std::vector<double> out(count);
      stream.fill(first, out);
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(out[i], stream.normal(first + i));
    }
}

TEST(NormalStream, NoiseIsTheStreamOfItsSeedAndTrial) {
  EXPECT_EQ((Noise{9, 3}.stream("a").normal(5)), NormalStream(9, 3, "a").normal(5));
}

TEST(NormalStream, UniformsLieStrictlyInsideTheUnitInterval) {
  const NormalStream stream(1, 0, "open");
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    EXPECT_GT(stream.uniform(i), 0.0);
    EXPECT_LT(stream.uniform(i), 1.0);
  }
}

// Moments of N(0, 1): standard errors sqrt((m_2k - m_k^2) / n). At 5 of them each of the six checks
// fails falsely at 6e-7.
TEST(NormalStream, MomentsAreThoseOfTheNormalDistribution) {
  constexpr std::array<double, 13> moments = {1, 0, 1, 0, 3, 0, 15, 0, 105, 0, 945, 0, 10395};
  const auto x = normals(2024, 11, "moments");
  for (std::size_t k = 1; k <= 6; ++k) {
    const double error =
        std::sqrt((moments[2 * k] - moments[k] * moments[k]) / static_cast<double>(draws));
    const double sample = mean(x, [&](double v) { return std::pow(v, static_cast<double>(k)); });
    EXPECT_NEAR(sample, moments[k], 5.0 * error) << "moment " << k;
  }
}

// Shares beyond a quantile are binomial; at 5 standard errors each of eight checks fails falsely at
// 6e-7 (by the normal approximation; the rarest share expects 13 draws).
TEST(NormalStream, TailsHoldTheirShareOfDraws) {
  const auto x = normals(2024, 12, "tails");
  for (const double quantile : {1.0, 2.0, 3.0, 4.0}) {
    const double share = 0.5 * std::erfc(quantile / std::numbers::sqrt2);
    const double error = std::sqrt(share * (1.0 - share) / static_cast<double>(draws));
    EXPECT_NEAR(mean(x, [&](double v) { return v > quantile; }), share, 5.0 * error) << quantile;
    EXPECT_NEAR(mean(x, [&](double v) { return v < -quantile; }), share, 5.0 * error) << quantile;
  }
}

// Kolmogorov's asymptotic distribution: P(sqrt(n) D > 2.7) = 2 exp(-2 2.7^2) = 9e-7.
TEST(NormalStream, TheEmpiricalDistributionIsNormalByKolmogorovAndSmirnov) {
  auto x = normals(2024, 13, "distribution");
  std::sort(x.begin(), x.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double cdf = 0.5 * std::erfc(-x[i] / std::numbers::sqrt2);
    distance = std::max({distance, std::abs(cdf - static_cast<double>(i) / draws),
                         std::abs(cdf - static_cast<double>(i + 1) / draws)});
  }
  EXPECT_LT(distance * std::sqrt(static_cast<double>(draws)), 2.7);
}

// A correlation of n independent pairs has standard error 1 / sqrt(n); at 5 of them each check
// fails falsely at 6e-7.
TEST(NormalStream, NeighbouringSeedsTrialsAndStreamsAreUncorrelated) {
  const auto base = normals(100, 5, "stream");
  EXPECT_LT(std::abs(scaled_correlation(base, normals(101, 5, "stream"))), 5.0);
  EXPECT_LT(std::abs(scaled_correlation(base, normals(100 + (1ULL << 32U), 5, "stream"))), 5.0);
  EXPECT_LT(std::abs(scaled_correlation(base, normals(~100ULL, 5, "stream"))), 5.0);
  EXPECT_LT(std::abs(scaled_correlation(base, normals(100, 6, "stream"))), 5.0);
  EXPECT_LT(std::abs(scaled_correlation(base, normals(100, 5, "streams"))), 5.0);
}

// As above; the squares have standard deviation sqrt(2), so their products' is 2.
TEST(NormalStream, NeighbouringSamplesAreUncorrelatedAndSoAreTheirSquares) {
  const auto x = normals(100, 8, "samples");
  for (const std::ptrdiff_t lag : {1, 2, 3, 4, 5, 8}) {
    std::vector<double> from(x.begin(), x.end() - lag), to(x.begin() + lag, x.end());
    EXPECT_LT(std::abs(scaled_correlation(from, to)), 5.0) << "lag " << lag;
    for (auto* values : {&from, &to})
      for (double& v : *values) v = v * v - 1.0;
    EXPECT_LT(std::abs(scaled_correlation(from, to)) / 2.0, 5.0) << "lag " << lag;
  }
}

TEST(NormalStream, NoTwoOfManyAddressesAgree) {
  std::vector<double> seen;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (std::uint32_t trial = 0; trial < 10; ++trial)
      for (const char* name : {"a", "b", "white_noise", "random_error", "compass"})
        for (std::uint64_t i = 0; i < 8; ++i)
          seen.push_back(NormalStream(seed, trial, name).normal(i));
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

/// What trials' deviates are mixed of is their sum, in whatever pieces it is drawn.
TEST(MixedNoise, IsTheSumOfItsShares) {
  const std::vector<NoiseShare> shares = {{3, 0.6}, {8, -0.8}};
  const NormalStream mixed(1, 0, "a", shares, nullptr);
  const auto one = normals(1, 3, "a", 1000), other = normals(1, 8, "a", 1000);
  std::vector<double> drawn(990);
  mixed.fill(7, drawn);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn[i], 0.0 + 0.6 * one[i + 7] + -0.8 * other[i + 7]) << i;
    EXPECT_EQ(drawn[i], mixed.normal(i + 7)) << i;
  }
}

TEST(MixedNoise, OfOneTrialAloneIsThatTrial) {
  const std::vector<NoiseShare> alone = {{5, 1.0}};
  const Noise mixed{1, 0, alone};
  std::vector<double> drawn(100);
  mixed.stream("a").fill(0, drawn);
  EXPECT_EQ(drawn, normals(1, 5, "a", 100));
}

/// A mixed uniform deviate is uniform: the largest distance of 20,000 from that has the law of
/// Kolmogorov, beyond 2.2 with probability 1.3e-4.
TEST(MixedNoise, UniformsStayUniform) {
  constexpr std::size_t count = 20'000;
  const std::vector<NoiseShare> shares = {{0, 0.6}, {1, 0.8}};
  const NormalStream mixed(2, 0, "u", shares, nullptr);
  std::vector<double> u(count);
  for (std::size_t i = 0; i < count; ++i) u[i] = mixed.uniform(i);
  std::sort(u.begin(), u.end());
  EXPECT_GT(u.front(), 0.0);
  EXPECT_LT(u.back(), 1.0);
  double farthest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    farthest = std::max(farthest, std::abs(u[i] - (static_cast<double>(i) + 0.5) / count));
  EXPECT_LT(farthest * std::sqrt(double(count)), 2.2);
}

TEST(MixedNoise, ATapeHoldsWhatWasDrawn) {
  const std::vector<NoiseShare> shares = {{3, 0.6}, {8, -0.8}};
  NoiseTape tape;
  const Noise noise{1, 0, shares, &tape};
  std::vector<double> drawn(10);
  noise.stream("a").fill(4, drawn);
  const double uniform = noise.stream("b").uniform(2);
  ASSERT_EQ(tape.at("a").size(), 14U);
  EXPECT_EQ(tape.at("a")[3], 0.0);
  EXPECT_EQ(tape.at("a")[5], drawn[1]);
  EXPECT_EQ(0.5 * std::erfc(-tape.at("b")[2] / std::numbers::sqrt2), uniform);
}

}  // namespace
}  // namespace gyrostat::random_test
