// Values cut off towards zero against rounded ones, by their counts next to zero, of noise that is
// less than a step.

#include <gyrostat/diagnosis/likelihood/counts_near_zero.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap::counts_near_zero_test {
namespace {

enum class Converter { rounds, cuts_off };
struct Sensor {
  double deviation, level, walk;  ///< in steps; of the walk, per sample
  bool has_tails = false;         ///< Student's t with four degrees of freedom
};

std::vector<CountsNearZero> counts(const Sensor& sensor, Converter converter, std::uint64_t seed) {
  constexpr std::uint64_t stretches = 57, samples = 256;
  const NormalStream noise(seed, 0, "noise"), walk(seed, 0, "walk"), tails(seed, 0, "tails");
  std::vector<CountsNearZero> all(stretches);
  double level = sensor.level;
  for (std::uint64_t i = 0; i < stretches * samples; ++i) {
    level += sensor.walk * walk.normal(i);
    double value = noise.normal(i);
    if (sensor.has_tails) {
      double squares = 0.0;
      for (std::uint64_t k = 0; k < 4; ++k) squares += std::pow(tails.normal(4 * i + k), 2);
      value /= std::sqrt(2.0 * squares / 4.0);  // of unit variance
    }
    value = level + sensor.deviation * value;
    value = converter == Converter::rounds ? std::nearbyint(value) : std::trunc(value);
    if (std::abs(value) <= reach_of_zero)
      all[i / samples][static_cast<std::size_t>(value + reach_of_zero)] += 1.0;
  }
  return all;
}

int told(const Sensor& sensor, Converter converter, std::uint64_t recordings) {
  int told = 0;
  for (std::uint64_t seed = 0; seed < recordings; ++seed)
    told += are_cut_off(counts(sensor, converter, seed));
  return told;
}

/// Half a step of noise shows three values at most times: only levels that move tell a wide zero,
/// and a walk of ten recordings may stay where it is in one or two.
TEST(CountsNearZero, OfNoiseBelowAStepAreToldWhereTheLevelMoves) {
  const Sensor walking{.deviation = 0.5, .level = 0.4, .walk = 0.01};
  EXPECT_GE(told(walking, Converter::cuts_off, 10), 8);
  EXPECT_EQ(told(walking, Converter::rounds, 10), 0);
  const Sensor resting{.deviation = 1.4, .level = 0.4, .walk = 0.0};
  EXPECT_EQ(told(resting, Converter::cuts_off, 10), 10);
  EXPECT_EQ(told(resting, Converter::rounds, 10), 0);
}

/// About a level next to zero a wide zero and heavy tails beside a narrow one are nearly alike.
TEST(CountsNearZero, OfRoundedValuesWithTailsAreNot) {
  for (const double deviation : {0.2, 0.3, 0.5})
    for (const double level : {-0.5, 0.0, 0.2})
      for (const double walk : {0.0, 0.003})
        EXPECT_EQ(told({deviation, level, walk, true}, Converter::rounds, 2), 0)
            << deviation << " " << level << " " << walk;
}

}  // namespace
}  // namespace gyrostat::gap::counts_near_zero_test
