// What several axes or sensors have in common.

#include <gyrostat/experiments/findings/shared_effects.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/generators/effects/noise_averaging.hpp>
#include <gyrostat/generators/effects/vibration.hpp>

namespace gyrostat::gap::shared_effects_test {
namespace {

/// A member with a vibration of the given standard deviation, known to `error`.
FleetMember with_vibration(const std::string& name, double std_dps, double error) {
  Diagnosis d;
  const Effect effect = effects::Vibration{.std_dps = std_dps};
  const double reach = 1.959964 * error;
  d.effects.push_back({.effect = "vibration", .parameters = {effect}});
  d.effects.back().intervals.assign(effect.fields().size(), {no_value, no_value});
  d.effects.back().intervals[0] = {std_dps - reach, std_dps + reach};
  d.verdict = Verdict::cause("vibration");
  return {name, d};
}

/// With equal errors s, the estimate of the spread is sqrt(sample variance - s^2), and the mean is
/// the plain one: Paule and Mandel's equation in closed form.
TEST(SharedEffects, SpreadIsWhatErrorsDoNotExplain) {
  const std::vector<FleetMember> members = {
      with_vibration("a", 1.0, 0.1), with_vibration("b", 1.6, 0.1), with_vibration("c", 2.2, 0.1)};
  const auto shared = shared_effects(members);
  ASSERT_EQ(shared.size(), 1);
  const auto& p = shared[0].parameters[0];
  EXPECT_NEAR(p.mean, 1.6, 1e-9);
  EXPECT_NEAR(p.spread, std::sqrt(0.36 - 0.01), 1e-9);
  EXPECT_LT(p.p_equal, 1e-6);
  EXPECT_TRUE(is_missing(shared[0].parameters[1].mean_low));
}

/// Where members differ by their errors alone, p is uniform and 95 % of the intervals hold the
/// truth. 400 families: standard error .011, so that five of them fail once in a million.
TEST(SharedEffects, HoldWhereMembersAreAlike) {
  constexpr int families = 400, size = 4;
  std::vector<double> normal(families * size);
  NormalStream(7, 0, "shared_effects_test").fill(0, normal);
  int below = 0, held = 0;
  for (int family = 0; family < families; ++family) {
    std::vector<FleetMember> members;
    for (int m = 0; m < size; ++m)
      members.push_back(with_vibration(
          std::to_string(m), 1.0 + 0.1 * normal[static_cast<std::size_t>(family * size + m)], 0.1));
    const auto p = shared_effects(members)[0].parameters[0];
    below += p.p_equal < 0.05 ? 1 : 0;
    held += p.mean_low <= 1.0 && 1.0 <= p.mean_high ? 1 : 0;
  }
  EXPECT_NEAR(below / double{families}, 0.05, 0.055);
  EXPECT_GT(held / double{families}, 0.90);
}

FleetMember with_averaging(const std::string& name, double length, double stages) {
  Diagnosis d;
  const Effect effect = effects::NoiseAveraging{.length = length, .stages = stages};
  d.effects.push_back({.effect = "noise_averaging", .parameters = {effect}});
  d.effects.back().intervals = {{length - 0.002, length + 0.002}, {no_value, no_value}};
  d.verdict = Verdict::cause("noise_averaging");
  return {name, d};
}

/// One average of 1.04 samples and two of 0.7 are two laws: equal within each, and never one mean.
TEST(SharedEffects, OfDifferingFormsAreToldApart) {
  const auto shared =
      shared_effects({with_averaging("a", 1.040, 1), with_averaging("b", 0.701, 2),
                      with_averaging("c", 1.041, 1), with_averaging("d", 0.700, 2)});
  ASSERT_EQ(shared.size(), 2);
  for (const auto& one : shared) {
    const bool once = one.form == "stages 1, of_samples 0";
    EXPECT_EQ(one.form, once ? "stages 1, of_samples 0" : "stages 2, of_samples 0");
    EXPECT_EQ(one.members,
              once ? std::vector<std::string>({"a", "c"}) : std::vector<std::string>({"b", "d"}));
    EXPECT_NEAR(one.parameters[0].mean, once ? 1.0405 : 0.7005, 1e-9);
    EXPECT_GT(one.parameters[0].p_equal, 0.1);
  }
  EXPECT_TRUE(shared_effects({with_averaging("a", 1.04, 1), with_averaging("b", 0.7, 2)}).empty());
}

TEST(SharedEffects, AreToldInWords) {
  FleetMember other{"c", {}};
  EXPECT_EQ(shared_in_words({with_vibration("a", 1.0, 0.1), with_vibration("b", 1.0, 0.1), other}),
            "Some have: vibration (a, b).");
  EXPECT_EQ(shared_in_words({with_vibration("a", 1.0, 0.1), with_vibration("b", 1.0, 0.1)}),
            "All have: vibration.");
  EXPECT_EQ(shared_in_words({other, other}), "None has an effect that has a name.");
}

}  // namespace
}  // namespace gyrostat::gap::shared_effects_test
