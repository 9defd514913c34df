#include "generators/effects/list.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "generators/scenario.hpp"

namespace gyrostat {
namespace {

template <class List>
struct TypesOf;
template <class... Plugins>
struct TypesOf<PluginList<Plugins...>> {
  using type = testing::Types<Plugins...>;
};

struct Ids {
  template <class Plugin>
  static std::string GetName(int) {
    return std::string(Plugin::id);
  }
};

/// What every effect owes to the scenario that it stands in.
template <class Plugin>
class EffectContract : public testing::Test {};
TYPED_TEST_SUITE(EffectContract, TypesOf<Effects>::type, Ids);

/// A warm and moving scenario with the given effects.
Series with(const std::vector<Effects::Any>& effects, const Noise& noise = {1, 0}) {
  Scenario scenario;
  scenario.sampling = {.duration_s = 300.0, .rate_hz = 10.0};
  scenario.thermal_drift = {.a_dps_per_C = 0.002, .b_dps_s_per_C = 0.3, .c_dps = -0.05};
  scenario.temperature = temperature::Cycle{.low_C = 20.0, .high_C = 60.0, .period_s = 200.0};
  scenario.motion = motion::Sinusoidal{};
  scenario.compass.disturbances = {{.start_s = 100.0, .duration_s = 50.0}};
  scenario.effects = effects;
  Series series;
  synthesise(scenario, noise, series);
  return series;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double u, double v) {
    return std::bit_cast<std::uint64_t>(u) == std::bit_cast<std::uint64_t>(v);
  });
}

bool same_bits(const Series& a, const Series& b) {
  for (const auto& channel : channels)
    if (!same_bits(a.*channel.values, b.*channel.values)) return false;
  return true;
}

bool is_strength(std::string_view name) {
  for (const auto word : {"amplitude", "curvature", "probability", "std", "strength", "gain", "offset"})
    if (name.find(word) != std::string_view::npos) return true;
  return false;
}

template <class Effect>
Effect of_no_strength() {
  Effect effect;
  for (const auto& field : effect.fields())
    if (is_strength(field.name)) effect.*(field.member) = 0.0;
  return effect;
}

/// At zero every strength is inside its range.
TYPED_TEST(EffectContract, HasAStrengthThatMayBeZero) {
  int strengths = 0;
  for (const auto& field : TypeParam::type::fields()) {
    if (!is_strength(field.name)) continue;
    ++strengths;
    EXPECT_TRUE(field.range.contains(0.0)) << field.name;
  }
  EXPECT_GT(strengths, 0);
}

TYPED_TEST(EffectContract, OfNoStrengthChangesNothing) {
  const auto none = of_no_strength<typename TypeParam::type>();
  EXPECT_TRUE(same_bits(with({none}), with({})));
}

TYPED_TEST(EffectContract, AtItsDefaultsChangesSomething) {
  EXPECT_FALSE(same_bits(with({typename TypeParam::type{}}), with({})));
}

/// The random error is what it was to the bit; the gyro has changed by the effect alone, wherever
/// other effects stand beside it.
TYPED_TEST(EffectContract, MovesNoDrawOfAnythingElse) {
  const typename TypeParam::type effect;
  Effects::for_each([&](auto plugin) {
    if (plugin.id == TypeParam::id) return;
    const typename decltype(plugin)::type other;
    const auto neither = with({}), one = with({effect}), two = with({other}), both = with({other, effect});
    EXPECT_TRUE(same_bits(neither.random_error_dps, both.random_error_dps)) << plugin.id;
    EXPECT_TRUE(same_bits(neither.heading_deg, both.heading_deg)) << plugin.id;
    for (std::size_t i = 0; i < neither.size(); ++i)
      ASSERT_NEAR(both.gyro_dps[i] - two.gyro_dps[i], one.gyro_dps[i] - neither.gyro_dps[i], 1e-12)
          << plugin.id << ", sample " << i;
  });
}

TYPED_TEST(EffectContract, TheOrderOfEffectsOfOneStageDoesNotChangeTheirSum) {
  const typename TypeParam::type effect;
  Effects::for_each([&](auto plugin) {
    const typename decltype(plugin)::type other;
    const auto a = with({effect, other}), b = with({other, effect});
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a.gyro_dps[i], b.gyro_dps[i], 1e-12);
  });
}

TYPED_TEST(EffectContract, IsAFunctionOfSeedAndTrial) {
  const typename TypeParam::type effect;
  EXPECT_TRUE(same_bits(with({effect}, {5, 2}), with({effect}, {5, 2})));
}

}  // namespace
}  // namespace gyrostat
