#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/likelihood/heading_bursts.hpp>
#include <gyrostat/diagnosis/simulator.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::heading_bursts_test {
namespace {

std::vector<double> white(std::size_t count, std::uint32_t trial) {
  const NormalStream noise(90, trial, "heading");
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(1.5 * noise.normal(i));
  return values;
}

const Conditions& conditions() {
  static const Simulator simulator(recorded(moving(), 90, true), 1);
  return simulator.conditions();
}

std::vector<char> none_misled() { return std::vector<char>(conditions().slow_size(), 0); }

/// Where a quarter of the means are 3.4 deg off and noise is 1.5 deg, half of all long runs reach
/// into a burst, on one side more than on the other: a median deviation of runs had hidden them.
TEST(HeadingBursts, AQuarterOfTheTimeAreFound) {
  const std::size_t n = conditions().slow_size();
  auto means = white(n, 0);
  std::vector<char> is_off(n, 0);
  for (const auto& [from, to, deg] : {std::array{0.02, 0.08, -3.4}, std::array{0.14, 0.2, -3.4},
                                      std::array{0.5, 0.58, 3.4}, std::array{0.93, 0.98, -3.4}})
    for (auto i = static_cast<std::size_t>(from * static_cast<double>(n));
         i < static_cast<std::size_t>(to * static_cast<double>(n)); ++i) {
      means[i] += deg;
      is_off[i] = 1;
    }
  const auto found = heading_bursts(conditions(), means, none_misled());
  double off = 0.0, both = 0.0;
  for (const auto& span : conditions().slow_spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      off += is_off[i];
      both += is_off[i] != 0 && found.hidden[i] != 0 ? 1.0 : 0.0;
    }
  EXPECT_GT(both / off, 0.9);
  EXPECT_NEAR(found.size_deg, 3.7, 0.4);  // with the noise of a mean
  // Four, of which the farthest runs are of 64 means, less what finding their places costs.
  EXPECT_GT(found.gain, 0.8 * 4.0 * 0.5 * 64.0 * 3.4 * 3.4 / (1.5 * 1.5));
}

/// Of noise alone, more than five deviations of some run are there in 2.5 % or less of trials: of
/// 200, more than 14 by chance once in a thousand times.
TEST(HeadingBursts, NoiseHasNone) {
  int found = 0;
  for (std::uint32_t trial = 1; trial <= 200; ++trial)
    found +=
        heading_bursts(conditions(), white(conditions().slow_size(), trial), none_misled()).gain >
                0.0
            ? 1
            : 0;
  EXPECT_LE(found, 14);
}

}  // namespace
}  // namespace gyrostat::gap::heading_bursts_test
