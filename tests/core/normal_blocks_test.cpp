#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/normals.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::normal_blocks_test {
namespace {

constexpr std::size_t chunk = 4 * normal_blocks;

struct Here;
using Block = NormalBlocks<Here, 1>;

std::array<std::uint32_t, 4> words(const NormalAddress& at, std::uint32_t block) {
  std::uint32_t w[4][1];
  Block::philox(at, block, w);
  return {w[0][0], w[1][0], w[2][0], w[3][0]};
}

/// kat_vectors of Random123 1.14 for philox4x32 with 10 rounds: zeros, ones, and the digits of pi.
TEST(NormalBlocks, PhiloxPassesThePublishedKnownAnswers) {
  const std::uint32_t ones = 0xffffffff;
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(words({{0, 0}, 0, {0, 0}}, 0), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(words({{ones, ones}, ones, {ones, ones}}, ones),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(words({{0xa4093822, 0x299f31d0}, 0x85a308d3, {0x13198a2e, 0x03707344}}, 0x243f6a88),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(NormalBlocks, PhiloxIsThatOfRandom123) {
  for (std::uint32_t k = 0; k < 10'000; ++k) {
    const NormalAddress at{{k * 7919U, ~k}, k ^ 0x5bd1e995U, {k * k, 2654435761U * k}};
    const auto expected =
        r123::Philox4x32{}({{k, at.trial, at.stream[0], at.stream[1]}}, {{at.key[0], at.key[1]}});
    const auto made = words(at, k);
    EXPECT_TRUE(std::equal(made.begin(), made.end(), expected.begin())) << k;
  }
}

/// Logarithm, sine and cosine are each within a unit in the last place (2^-52), of which the root
/// halves the first, and three roundings follow: a deviate is within 4 x 2^-53 of Box and Muller's
/// formulas on exact numbers.
TEST(NormalBlocks, DeviatesAreWithinFourRoundingsOfBoxMuller) {
  const NormalAddress at{{1, 2}, 3, {4, 5}};
  for (std::uint32_t block = 0; block < 500'000; ++block) {
    const auto w = words(at, block);
    std::array<double, 4> made{};
    Block::normals(at, block, made.data());
    for (std::size_t pair = 0; pair < 4; pair += 2) {
      const auto unit = [](std::uint32_t word) { return (word + 0.5L) / 4294967296.0L; };
      const long double radius = std::sqrt(-2.0L * std::log(unit(w[pair])));
      const long double angle = 2.0L * std::numbers::pi_v<long double> * unit(w[pair + 1]);
      for (const auto& [value, exact] : {std::pair{made[pair], radius * std::cos(angle)},
                                         std::pair{made[pair + 1], radius * std::sin(angle)}})
        // pi in long double and cos of it are themselves good to 1e-19 of a turn.
        ASSERT_LE(std::abs(value - exact), 4 * 0x1p-53L * std::abs(exact) + 1e-18L) << block;
    }
  }
}

TEST(NormalBlocks, EveryInstructionSetGivesTheSameBits) {
  for (const Kernels* kernels : available_kernels())
    for (std::uint32_t first = 0; first < 20'000; first += normal_blocks) {
      const NormalAddress at{{first, 17}, 3, {~first, 5}};
      std::array<double, chunk> packed{}, alone{};
      kernels->normals(at, first, packed.data());
      for (std::uint32_t i = 0; i < normal_blocks; ++i)
        Block::normals(at, first + i, &alone[4 * i]);
      for (std::size_t i = 0; i < chunk; ++i)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(packed[i]), std::bit_cast<std::uint64_t>(alone[i]))
            << kernels->target << ", " << first << ", " << i;
    }
}

double upper_tail(double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); }

// Counts beyond a quantile are binomial, far out Poisson. At 5 standard errors each of the ten
// checks up to 5 sigma (57 expected there) fails falsely at 1e-6; beyond 6 sigma 0.2 draws are
// expected on either side and more than 6 have probability 2e-9 (Poisson).
TEST(NormalBlocks, TailsHoldTheirShareToSixSigma) {
  constexpr std::size_t draws = 200'000'000;
  const NormalStream stream(2024, 14, "tails");
  std::array<std::size_t, 7> above{}, below{};
  std::vector<double> x(1 << 16);
  for (std::size_t done = 0; done < draws; done += x.size()) {
    stream.fill(done, x);
    for (const double v : x) {
      if (v > 1.0) ++above[static_cast<std::size_t>(v)];
      if (v < -1.0) ++below[static_cast<std::size_t>(-v)];
    }
  }
  const auto total = static_cast<double>((draws + x.size() - 1) / x.size() * x.size());
  for (std::size_t sigma = 6; sigma >= 1; --sigma) {
    if (sigma < 6) above[sigma] += above[sigma + 1], below[sigma] += below[sigma + 1];
    const double share = upper_tail(static_cast<double>(sigma));
    const double error = std::sqrt(total * share * (1.0 - share));
    for (const auto count : {above[sigma], below[sigma]}) {
      if (sigma == 6)
        EXPECT_LE(count, 6U);
      else
        EXPECT_NEAR(static_cast<double>(count), total * share, 5.0 * error) << sigma;
    }
  }
}

// A^2 of a sample from the distribution itself exceeds 6 with probability 1.0e-3, and beyond that
// its tail falls as exp(-A^2) (Marsaglia and Marsaglia 2004, "Evaluating the Anderson-Darling
// distribution"): 13 is passed falsely at 1e-6.
TEST(NormalBlocks, DeviatesAreNormalByAndersonAndDarling) {
  constexpr std::size_t draws = 2'000'000;
  std::vector<double> x(draws);
  NormalStream(2024, 15, "anderson_darling").fill(0, x);
  std::sort(x.begin(), x.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < draws; ++i)
    sum += (2.0 * static_cast<double>(i) + 1.0) *
           (std::log(upper_tail(-x[i])) + std::log(upper_tail(x[draws - 1 - i])));
  const double squared = -static_cast<double>(draws) - sum / static_cast<double>(draws);
  EXPECT_LT(squared, 13.0);
  EXPECT_GT(squared, 0.0);
}

}  // namespace
}  // namespace gyrostat::normal_blocks_test
