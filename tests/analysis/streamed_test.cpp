#include <gyrostat/analysis/statistics/streamed.hpp>

#include <bit>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace gyrostat::streamed_test {
namespace {

using Values = std::vector<double>;

std::uint64_t bits(double v) { return std::isnan(v) ? 0 : std::bit_cast<std::uint64_t>(v); }

/// Passes until it asks for no more.
Summary streamed(const Values& values) {
  StreamedSummary stream;
  do
    for (const double v : values) stream.add(v);
  while (stream.another_pass());
  return stream.summary();
}

void expect_same_bits(const Summary& a, const Summary& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.missing, b.missing);
  EXPECT_EQ(bits(a.mean), bits(b.mean));
  EXPECT_EQ(bits(a.half_width_95), bits(b.half_width_95));
  EXPECT_EQ(bits(a.std), bits(b.std));
  EXPECT_EQ(bits(a.median), bits(b.median));
  EXPECT_EQ(bits(a.percentile_95), bits(b.percentile_95));
  EXPECT_EQ(bits(a.worst), bits(b.worst));
}

Values drawn(std::size_t count, const std::function<double(std::mt19937_64&)>& draw) {
  std::mt19937_64 random(20260);
  Values values(count);
  for (double& v : values) v = draw(random);
  return values;
}

double normal(std::mt19937_64& random) { return std::normal_distribution<double>{}(random); }

// 16384 values are kept as they are; beyond, they are counted in bins.
TEST(StreamedSummary, HasTheBitsOfASummaryOfAllValuesAtOnce) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 20U, 16384U, 16385U, 100000U}) {
    SCOPED_TRACE(count);
    const auto centred = drawn(count, normal);
    expect_same_bits(streamed(centred), summarise(centred));
    const auto narrow = drawn(count, [](auto& r) { return 3.0 + 1e-9 * normal(r); });
    expect_same_bits(streamed(narrow), summarise(narrow));
    const auto heavy = drawn(count, [](auto& r) { return std::exp(20.0 * normal(r)); });
    expect_same_bits(streamed(heavy), summarise(heavy));
  }
}

TEST(StreamedSummary, HasTheBitsWhereManyValuesAreEqual) {
  for (const std::size_t count : {5U, 50000U}) {
    SCOPED_TRACE(count);
    const Values constant(count, -0.25);
    expect_same_bits(streamed(constant), summarise(constant));
    const auto few = drawn(count, [](auto& r) { return static_cast<double>(r() % 3); });
    expect_same_bits(streamed(few), summarise(few));
    // The median lies between two numbers, each there more often than may be kept.
    Values halves(count - count % 2, 1.0);
    for (std::size_t i = 0; i < halves.size() / 2; ++i) halves[i] = 2.0;
    expect_same_bits(streamed(halves), summarise(halves));
  }
}

TEST(StreamedSummary, CountsMissingValuesAndLeavesThemOut) {
  auto values = drawn(30000, normal);
  for (std::size_t i = 0; i < values.size(); i += 3) values[i] = no_value;
  expect_same_bits(streamed(values), summarise(values));
  EXPECT_EQ(streamed(values).missing, 10000U);
  const Values none(7, no_value);
  expect_same_bits(streamed(none), summarise(none));
}

}  // namespace
}  // namespace gyrostat::streamed_test
