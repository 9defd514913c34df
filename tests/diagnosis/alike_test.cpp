// What the axes of one sensor have alike, on axes whose effects are known.

#include <gyrostat/diagnosis/likelihood/alike.hpp>

#include <algorithm>
#include <cmath>
#include <deque>

#include <gtest/gtest.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::alike_test {
namespace {

/// The axes of a sensor with what is found of each alone, which is asked of them.
class Sensor {
 public:
  void add(const Scenario& axis, std::uint64_t seed) {
    recordings_.push_back(recorded(axis, seed, false));
    simulators_.emplace_back(recordings_.back(), 1);
    axes_.push_back(find_set(simulators_.back(), recordings_.back(), {}));
  }
  const std::vector<FoundSet>& axes() const { return axes_; }

 private:
  std::deque<Series> recordings_;
  std::deque<Simulator> simulators_;
  std::vector<FoundSet> axes_;
};

/// Three axes, each with noise of its own size and the effect that is given for it.
template <class EffectOf>
Sensor sensor_with(std::uint64_t seed, const EffectOf& effect_of) {
  Sensor sensor;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Scenario s = still();
    s.random_error.measurement_noise_std_dps = 0.04 + 0.01 * static_cast<double>(axis);
    if (auto effect = effect_of(axis)) s.effects = {*effect};
    sensor.add(s, 10 * seed + axis);
  }
  return sensor;
}

using MaybeEffect = std::optional<Effect>;

bool is_of_filter(const std::string& effect) {
  return effect == "noise_averaging" || effect == "noise_bandwidth";
}

/// An average over 1.03 samples correlates neighbours by .03: some 8 nats an axis of 18,000
/// samples, deviation 4, against a cost of 6. Of all axes it is 24, deviation 7: 99 % of sensors.
/// Four are tried; all are found in 96 % of runs under other seeds. A filter does the same.
TEST(AlikeOnAxes, WhatIsWeakOnEachIsFoundOnAll) {
  int alone = 0, together = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto sensor = sensor_with(seed, [](std::size_t) -> MaybeEffect {
      return effects::NoiseAveraging{1.03, 1.0};
    });
    for (const auto& axis : sensor.axes())
      alone +=
          static_cast<int>(std::count_if(axis.members.begin(), axis.members.end(),
                                         [](const auto& m) { return is_of_filter(m.effect); }));
    for (const auto& given : alike_on_axes(sensor.axes())) {
      together += static_cast<int>(given.size());
      for (const auto& g : given) EXPECT_TRUE(is_of_filter(std::string(g.effect.id())));
    }
  }
  EXPECT_EQ(together, 12);
  EXPECT_LT(alone, together);
}

/// Averages of three lengths: told apart by thirty standard errors and more.
TEST(AlikeOnAxes, ThoseThatDifferKeepTheirOwn) {
  const auto sensor = sensor_with(5, [](std::size_t axis) -> MaybeEffect {
    return effects::NoiseAveraging{1.2 + 0.5 * static_cast<double>(axis), 1.0};
  });
  for (const auto& axis : sensor.axes()) EXPECT_FALSE(axis.members.empty());
  for (const auto& given : alike_on_axes(sensor.axes())) EXPECT_TRUE(given.empty());
}

TEST(AlikeOnAxes, WhatOneAloneHasStaysThere) {
  const auto sensor = sensor_with(6, [](std::size_t axis) -> MaybeEffect {
    if (axis != 1) return {};
    return effects::NoiseAveraging{1.2, 1.0};
  });
  EXPECT_FALSE(sensor.axes()[1].members.empty());
  for (const auto& given : alike_on_axes(sensor.axes())) EXPECT_TRUE(given.empty());
}

/// Of one value for three axes the error is 1 / sqrt(3) of what each alone has; it holds the truth
/// within four of its errors (6e-5), and so long as the axes are alike p_equal is not below 1e-4.
TEST(AlikeOnAxes, IsKnownAsWellAsAllTogetherKnowIt) {
  constexpr double length = 1.6;
  const auto sensor = sensor_with(7, [](std::size_t) -> MaybeEffect {
    return effects::NoiseAveraging{length, 1.0};
  });
  double weights = 0.0;
  for (const auto& axis : sensor.axes())
    for (const auto& interval : axis.intervals)
      if (axis.scenario.effects[interval.effect].id() == "noise_averaging")
        weights += std::pow(interval.high - interval.low, -2.0);
  const auto given = alike_on_axes(sensor.axes());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(given[axis].size(), 1);
    const auto& one = given[axis].front();
    const auto field = field_of(one.effect, "length");
    const auto [low, high] = one.intervals[field];
    EXPECT_NEAR((high - low) * std::sqrt(weights), 1.0, 1e-6);
    EXPECT_NEAR(one.effect.value(field), length, 4.0 * (high - low) / (2.0 * 1.96));
    EXPECT_GT(one.p_equal, 1e-4);
    const auto beside = sensor.axes()[axis].beside(given[axis]);
    ASSERT_TRUE(has(beside.scenario, "noise_averaging"));
    EXPECT_EQ(beside.scenario.effects.front().value(field), one.effect.value(field));
    EXPECT_EQ(beside.members.front().given, true);
  }
}

/// One time constant, and on each axis another sensitivity. Alone the third has 2 to 5 nats, too
/// few to be found.
TEST(AlikeOnAxes, ALagHasOneTimeConstantAndManySensitivities) {
  const double sensitivities[] = {0.03, -0.02, 0.015};
  const auto sensor = sensor_with(8, [&](std::size_t axis) -> MaybeEffect {
    return effects::ThermalLag{sensitivities[axis], 60.0};
  });
  const auto given = alike_on_axes(sensor.axes());
  std::vector<double> time_constants;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(given[axis].size(), 1);
    EXPECT_EQ(given[axis].front().effect.id(), "thermal_lag");
    const auto beside = sensor.axes()[axis].beside(given[axis]);
    const auto lag = std::find_if(beside.scenario.effects.begin(), beside.scenario.effects.end(),
                                  [](const auto& e) { return e.id() == "thermal_lag"; });
    ASSERT_NE(lag, beside.scenario.effects.end());
    time_constants.push_back(lag->value(field_of(*lag, "time_constant_s")));
    EXPECT_GT(lag->value(field_of(*lag, "sensitivity_dps_per_C")) / sensitivities[axis], 0.0);
  }
  EXPECT_EQ(time_constants[0], time_constants[1]);
  EXPECT_EQ(time_constants[0], time_constants[2]);
  EXPECT_NEAR(time_constants[0], 60.0, 20.0);
}

}  // namespace
}  // namespace gyrostat::gap::alike_test
