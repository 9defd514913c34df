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

/// One effect of the list, with its defaults and absent.
struct Listed {
  Effect effect, absent;
};

const std::vector<Listed>& listed() {
  static const std::vector<Listed> all = [] {
    std::vector<Listed> to;
    Effects::for_each([&]<class Plugin>(Plugin) {
      constexpr auto absent = Plugin::type::absent();
      to.push_back({typename Plugin::type{}, absent});
    });
    return to;
  }();
  return all;
}

std::vector<std::string> ids() {
  std::vector<std::string> ids;
  for (const auto& one : listed()) ids.emplace_back(one.effect.id());
  return ids;
}

/// What every effect owes to the scenario that it stands in.
class EffectContract : public testing::TestWithParam<std::string> {
 protected:
  const Listed& it() const {
    return *std::find_if(listed().begin(), listed().end(),
                         [](const Listed& one) { return one.effect.id() == GetParam(); });
  }
};
INSTANTIATE_TEST_SUITE_P(Each, EffectContract, testing::ValuesIn(ids()),
                         [](const auto& given) { return given.param; });

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

TEST_P(EffectContract, AbsentItChangesNothing) {
  const Effect& absent = it().absent;
  EXPECT_TRUE(same_bits(applied(absent, plain()), plain()));
  EXPECT_TRUE(same_bits(under(rich_conditions(), {absent}), plain()));
  EXPECT_TRUE(same_bits(with({absent}), with({})));
}

/// What acts sample by sample may be given samples from anywhere, in any order, of any trials: here
/// backwards, each twice.
TEST_P(EffectContract, SampleBySampleItDoesNotMatterWhereTheyStand) {
  const Effect& effect = it().effect;
  if (!effect.is_sample_by_sample()) GTEST_SKIP() << "it does not say so";
  EXPECT_GE(effect.stage(), Stage::noise);
  EXPECT_NE(effect.stage(), Stage::compass);
  const auto rearranged = [](const Series& series) {
    Series to;
    for (const auto& channel : channels) {
      const auto& from = series.*channel.values;
      for (std::size_t i = from.size(); i-- > 0;)
        (to.*channel.values).insert((to.*channel.values).end(), 2, from[i]);
    }
    return to;
  };
  const Series once = applied(effect, plain());
  EXPECT_FALSE(same_bits(once.gyro_dps, plain().gyro_dps));
  EXPECT_TRUE(same_bits(applied(effect, rearranged(plain()), {2, 5}), rearranged(once)));
}

TEST_P(EffectContract, AbsentItIsWithinItsRanges) {
  const Effect& absent = it().absent;
  for (std::size_t i = 0; i < absent.fields().size(); ++i)
    EXPECT_TRUE(absent.fields()[i].range.contains(absent.value(i))) << absent.fields()[i].name;
}

TEST_P(EffectContract, AtItsDefaultsChangesTheChannelOfItsStageAndNoOther) {
  const Effect& effect = it().effect;
  const auto after = applied(effect, plain());
  for (const auto& channel : channels)
    EXPECT_EQ(same_bits(after.*channel.values, plain().*channel.values),
              channel.values != channel_of(effect.stage()))
        << channel.name;
}

TEST_P(EffectContract, AtItsDefaultsShowsInTheScenario) {
  const auto& before = plain();
  const auto after = under(rich_conditions(), {it().effect});
  const auto stage = it().effect.stage();
  const auto seen = stage == Stage::compass ? &Series::heading_deg : &Series::gyro_dps;
  EXPECT_FALSE(same_bits(after.*seen, before.*seen));
}

TEST_P(EffectContract, IsFiniteWhateverItsRangesAllow) {
  const Effect& defaults = it().effect;
  EXPECT_TRUE(all_finite(applied(defaults, plain())));
  for (std::size_t i = 0; i < defaults.fields().size(); ++i) {
    const auto& field = defaults.fields()[i];
    for (const double factor : {0.01, 0.5, 2.0, 100.0}) {
      auto effect = defaults;
      effect.value(i) *= factor;
      if (!field.range.contains(effect.value(i))) continue;
      EXPECT_TRUE(all_finite(applied(effect, plain()))) << field.name << " times " << factor;
    }
    if (!field.range.contains(0.0)) continue;
    auto effect = defaults;
    effect.value(i) = 0.0;
    EXPECT_TRUE(all_finite(applied(effect, plain()))) << field.name << " = 0";
  }
}

TEST_P(EffectContract, AloneWithOneSampleOrNoneIsFinite) {
  for (const std::size_t samples : {0, 1, 2})
    EXPECT_TRUE(all_finite(applied(it().effect, plain().slice(0, samples)))) << samples;
}

TEST_P(EffectContract, WithoutAChannelThatItNeedsChangesNothing) {
  const Effect& effect = it().effect;
  for (const auto channel : effect.type().needs) {
    auto series = plain();
    (series.*channel).clear();
    EXPECT_TRUE(same_bits(applied(effect, series), series));
  }
}

TEST_P(EffectContract, NeedsNoOtherChannel) {
  const Effect& effect = it().effect;
  auto series = plain();
  for (const auto& channel : channels) {
    const auto is_needed = [&](auto needed) { return needed == channel.values; };
    if (std::none_of(effect.type().needs.begin(), effect.type().needs.end(), is_needed) &&
        channel.name != "t_s")
      (series.*channel.values).clear();
  }
  const auto changed = channel_of(effect.stage());
  EXPECT_TRUE(same_bits(applied(effect, series).*changed, applied(effect, plain()).*changed));
}

/// In a recording with gaps every sample that the recording has is finite.
TEST_P(EffectContract, BridgesTheGapsOfARecording) {
  auto conditions = rich_conditions();
  conditions.gyro_dps.resize(conditions.size());
  for (const auto& channel : channels) {
    auto& values = conditions.*channel.values;
    for (std::size_t i = 0; channel.name != "t_s" && i < values.size(); ++i)
      if (i % 1000 < 7) values[i] = no_value;
  }
  const auto series = under(conditions, {it().effect});
  for (const auto& channel : {&Series::gyro_dps, &Series::heading_deg})
    for (std::size_t i = 0; i < series.size(); ++i)
      ASSERT_EQ(std::isfinite((series.*channel)[i]), i % 1000 >= 7) << i;
}

TEST_P(EffectContract, AppliedToAGapDoesNotFail) {
  const Effect& effect = it().effect;
  auto series = plain();
  for (const auto channel : effect.type().needs) (series.*channel)[100] = no_value;
  EXPECT_TRUE(same_bits(applied(effect, series), applied(effect, series)));
}

TEST_P(EffectContract, TakesUnevenTimes) {
  auto series = plain();
  for (std::size_t i = 0; i < series.size(); ++i)
    series.t_s[i] = 1.7e9 + 0.1 * (static_cast<double>(i) + (i % 3 == 1 ? 0.4 : 0.0)) +
                    (i > 9000 ? 500.0 : 0.0);
  EXPECT_TRUE(all_finite(applied(it().effect, series)));
}

/// The random error is what it was to the bit, and what each effect adds is the same wherever other
/// effects stand beside it.
TEST_P(EffectContract, MovesNoDrawOfAnythingElse) {
  const Effect& effect = it().effect;
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
    // What one has the rate sensed as, the other sees.
    if (effect.is_response() || other.is_response()) continue;
    EXPECT_TRUE(same_bits(neither.heading_deg, both.heading_deg)) << type.id;
    for (std::size_t i = 0; i < neither.size(); ++i)
      ASSERT_NEAR(both.gyro_dps[i] - two.gyro_dps[i], one.gyro_dps[i] - neither.gyro_dps[i], 1e-12)
          << type.id << ", sample " << i;
  }
}

TEST_P(EffectContract, TheOrderOfEffectsOfOneStageDoesNotChangeTheirSum) {
  const Effect& effect = it().effect;
  if (!is_additive(effect.stage())) return;
  for (const auto& type : effect_types()) {
    if (!is_additive(type.stage)) continue;
    const Effect other(type);
    if (effect.is_response() && other.is_response()) continue;
    const auto a = with({effect, other}), b = with({other, effect});
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a.gyro_dps[i], b.gyro_dps[i], 1e-12);
  }
}

TEST_P(EffectContract, IsAFunctionOfSeedAndTrial) {
  const Effect& effect = it().effect;
  EXPECT_TRUE(same_bits(with({effect}, {5, 2}), with({effect}, {5, 2})));
}

}  // namespace
}  // namespace gyrostat::effects_test
