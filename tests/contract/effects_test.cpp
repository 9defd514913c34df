#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/acceleration/list.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::effects_test {
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
Series with(const std::vector<Effect>& effects, const Noise& noise = {1, 0}) {
  Scenario scenario;
  scenario.sampling = {.duration_s = 300.0, .rate_hz = 10.0};
  scenario.thermal_drift = {.a_dps_per_C = 0.002, .b_dps_s_per_C = 0.3, .c_dps = -0.05};
  scenario.temperature = temperature::Cycle{.low_C = 20.0, .high_C = 60.0, .period_s = 200.0};
  scenario.motion = motion::Sinusoidal{};
  scenario.cross_motion_1 = motion::Sinusoidal{.amplitude_dps = 20.0, .frequency_hz = 0.07};
  scenario.cross_motion_2 = motion::Sinusoidal{.amplitude_dps = 20.0, .frequency_hz = 0.03};
  scenario.acceleration = acceleration::Shaking{};
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

/// The channel that a stage's effects may change.
std::vector<double> Series::*channel_of(Stage stage) {
  if (stage == Stage::sensing) return &Series::thermal_bias_dps;
  return stage == Stage::compass ? &Series::heading_deg : &Series::gyro_dps;
}

/// Its changes add up with those of its like.
bool is_additive(Stage stage) { return stage == Stage::sensing || stage == Stage::electronics; }

/// An hour with all channels: warming, tilting, and turning at small, middling and large rates.
Series rich_conditions() {
  Series conditions;
  const acceleration::Tilting tilting;
  constexpr std::array rates = {0.2, 0.0, -0.2, 20.0, -20.0, 150.0, -150.0, 0.0};
  for (std::size_t i = 0; i < 36000; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    conditions.t_s.push_back(t);
    conditions.temperature_C.push_back(20.0 + 40.0 * t / 3600.0);
    conditions.rate_ref_dps.push_back(rates[i / 100 % rates.size()]);
    const auto [x, y, z] = tilting(t);
    conditions.acc_x_mps2.push_back(x);
    conditions.acc_y_mps2.push_back(y);
    conditions.acc_z_mps2.push_back(z);
    conditions.cross_rate_1_dps.push_back(rates[i / 150 % rates.size()]);
    conditions.cross_rate_2_dps.push_back(rates[i / 250 % rates.size()]);
  }
  conditions.heading_deg.resize(conditions.size());
  conditions.mag_valid.resize(conditions.size(), 1.0);
  return conditions;
}

Series under(const Series& conditions, const std::vector<Effect>& effects) {
  Scenario scenario;
  scenario.thermal_drift = {.a_dps_per_C = 0.002, .b_dps_s_per_C = 0.3, .c_dps = -0.05};
  scenario.effects = effects;
  Series series;
  synthesise_under(scenario, conditions, {1, 0}, series);
  return series;
}

/// A signal without effects, with every channel.
const Series& plain() {
  static const Series series = under(rich_conditions(), {});
  return series;
}

template <class Effect>
Series applied(const Effect& effect, Series series, const Noise& noise = {1, 0}) {
  effect.apply(series, noise);
  return series;
}

bool all_finite(const Series& series) {
  return std::all_of(channels.begin(), channels.end(), [&](const Channel& channel) {
    const auto& values = series.*channel.values;
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  });
}

TYPED_TEST(EffectContract, AbsentItChangesNothing) {
  constexpr auto absent = TypeParam::type::absent();
  EXPECT_TRUE(same_bits(applied(absent, plain()), plain()));
  EXPECT_TRUE(same_bits(under(rich_conditions(), {absent}), plain()));
  EXPECT_TRUE(same_bits(with({absent}), with({})));
}

TYPED_TEST(EffectContract, AbsentItIsWithinItsRanges) {
  constexpr auto absent = TypeParam::type::absent();
  for (const auto& field : absent.fields())
    EXPECT_TRUE(field.range.contains(absent.*(field.member))) << field.name;
}

TYPED_TEST(EffectContract, AtItsDefaultsChangesTheChannelOfItsStageAndNoOther) {
  const typename TypeParam::type effect;
  const auto after = applied(effect, plain());
  for (const auto& channel : channels)
    EXPECT_EQ(same_bits(after.*channel.values, plain().*channel.values),
              channel.values != channel_of(effect.stage))
        << channel.name;
}

TYPED_TEST(EffectContract, AtItsDefaultsShowsInTheScenario) {
  const auto& before = plain();
  const auto after = under(rich_conditions(), {typename TypeParam::type{}});
  const auto stage = TypeParam::type::stage;
  const auto seen = stage == Stage::compass ? &Series::heading_deg : &Series::gyro_dps;
  EXPECT_FALSE(same_bits(after.*seen, before.*seen));
}

TYPED_TEST(EffectContract, IsFiniteWhateverItsRangesAllow) {
  const typename TypeParam::type defaults;
  EXPECT_TRUE(all_finite(applied(defaults, plain())));
  for (const auto& field : defaults.fields()) {
    for (const double factor : {0.01, 0.5, 2.0, 100.0}) {
      auto effect = defaults;
      effect.*(field.member) *= factor;
      if (!field.range.contains(effect.*(field.member))) continue;
      EXPECT_TRUE(all_finite(applied(effect, plain()))) << field.name << " times " << factor;
    }
    if (!field.range.contains(0.0)) continue;
    auto effect = defaults;
    effect.*(field.member) = 0.0;
    EXPECT_TRUE(all_finite(applied(effect, plain()))) << field.name << " = 0";
  }
}

TYPED_TEST(EffectContract, AloneWithOneSampleOrNoneIsFinite) {
  for (const std::size_t samples : {0, 1, 2})
    EXPECT_TRUE(all_finite(applied(typename TypeParam::type{}, plain().slice(0, samples))))
        << samples;
}

TYPED_TEST(EffectContract, WithoutAChannelThatItNeedsChangesNothing) {
  const typename TypeParam::type effect;
  for (const auto channel : effect.needs) {
    auto series = plain();
    (series.*channel).clear();
    EXPECT_TRUE(same_bits(applied(effect, series), series));
  }
}

TYPED_TEST(EffectContract, NeedsNoOtherChannel) {
  const typename TypeParam::type effect;
  auto series = plain();
  for (const auto& channel : channels) {
    const auto is_needed = [&](auto needed) { return needed == channel.values; };
    if (std::none_of(effect.needs.begin(), effect.needs.end(), is_needed) && channel.name != "t_s")
      (series.*channel.values).clear();
  }
  const auto changed = channel_of(effect.stage);
  EXPECT_TRUE(same_bits(applied(effect, series).*changed, applied(effect, plain()).*changed));
}

/// In a recording with gaps every sample that the recording has is finite.
TYPED_TEST(EffectContract, BridgesTheGapsOfARecording) {
  auto conditions = rich_conditions();
  conditions.gyro_dps.resize(conditions.size());
  for (const auto& channel : channels) {
    auto& values = conditions.*channel.values;
    for (std::size_t i = 0; channel.name != "t_s" && i < values.size(); ++i)
      if (i % 1000 < 7) values[i] = no_value;
  }
  const auto series = under(conditions, {typename TypeParam::type{}});
  for (const auto& channel : {&Series::gyro_dps, &Series::heading_deg})
    for (std::size_t i = 0; i < series.size(); ++i)
      ASSERT_EQ(std::isfinite((series.*channel)[i]), i % 1000 >= 7) << i;
}

TYPED_TEST(EffectContract, AppliedToAGapDoesNotFail) {
  const typename TypeParam::type effect;
  auto series = plain();
  for (const auto channel : effect.needs) (series.*channel)[100] = no_value;
  EXPECT_TRUE(same_bits(applied(effect, series), applied(effect, series)));
}

TYPED_TEST(EffectContract, TakesUnevenTimes) {
  auto series = plain();
  for (std::size_t i = 0; i < series.size(); ++i)
    series.t_s[i] = 1.7e9 + 0.1 * (static_cast<double>(i) + (i % 3 == 1 ? 0.4 : 0.0)) +
                    (i > 9000 ? 500.0 : 0.0);
  EXPECT_TRUE(all_finite(applied(typename TypeParam::type{}, series)));
}

/// The random error is what it was to the bit, and what each effect adds is the same wherever other
/// effects stand beside it.
TYPED_TEST(EffectContract, MovesNoDrawOfAnythingElse) {
  const Effect effect = typename TypeParam::type{};
  const auto neither = with({}), one = with({effect});
  for (const auto& type : effect_types()) {
    if (type.id == effect.id()) continue;
    const Effect other(type);
    const auto two = with({other}), both = with({other, effect});
    EXPECT_TRUE(same_bits(neither.random_error_dps, both.random_error_dps)) << type.id;
    EXPECT_TRUE(same_bits(neither.rate_ref_dps, both.rate_ref_dps)) << type.id;
    EXPECT_TRUE(same_bits(neither.temperature_C, both.temperature_C)) << type.id;
    EXPECT_TRUE(same_bits(neither.mag_valid, both.mag_valid)) << type.id;
    if (!is_additive(effect.stage()) || !is_additive(other.stage())) continue;
    EXPECT_TRUE(same_bits(neither.heading_deg, both.heading_deg)) << type.id;
    for (std::size_t i = 0; i < neither.size(); ++i)
      ASSERT_NEAR(both.gyro_dps[i] - two.gyro_dps[i], one.gyro_dps[i] - neither.gyro_dps[i], 1e-12)
          << type.id << ", sample " << i;
  }
}

TYPED_TEST(EffectContract, TheOrderOfEffectsOfOneStageDoesNotChangeTheirSum) {
  const Effect effect = typename TypeParam::type{};
  if (!is_additive(effect.stage())) return;
  for (const auto& type : effect_types()) {
    if (!is_additive(type.stage)) continue;
    const Effect other(type);
    const auto a = with({effect, other}), b = with({other, effect});
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a.gyro_dps[i], b.gyro_dps[i], 1e-12);
  }
}

TYPED_TEST(EffectContract, IsAFunctionOfSeedAndTrial) {
  const typename TypeParam::type effect;
  EXPECT_TRUE(same_bits(with({effect}, {5, 2}), with({effect}, {5, 2})));
}

}  // namespace
}  // namespace gyrostat::effects_test
