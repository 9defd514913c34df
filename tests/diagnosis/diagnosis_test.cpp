// The diagnosis on recordings whose cause is known.

#include <nlohmann/json.hpp>

#include <gyrostat/diagnosis/diagnosis.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::diagnosis_test {
namespace {

/// Twenty seconds at the start of seven minutes and a half: nothing can be read off the rest.
TEST(Diagnosis, APartWithoutReadingsIsRefused) {
  Scenario s = still();
  s.sampling.duration_s = 450.0;
  Series series = recorded(s, 6, false);
  series.heading_deg.clear();
  for (std::size_t i = 0; i < series.size(); ++i)
    if (series.t_s[i] > 19.0) series.gyro_dps[i] = no_value;
  EXPECT_THROW(diagnose(series, {}), InputError);
}

/// A magnet that passes within the part that is held back, 2 deg for 20 s: a clear burst, once
/// another part is held back. Without its name it stays unknown.
TEST(Diagnosis, WhatIsInTheHeldOutPartAloneIsNamedWhereAnotherIsHeldOut) {
  Scenario s = still(ten_minutes_s);
  s.sampling.duration_s = 600.0;
  Series series = recorded(s, 7, false);
  DiagnosisOptions nameless;
  nameless.without = {"magnetic_bursts"};
  const auto plain = diagnose(series, nameless);
  EXPECT_EQ(plain.verdict, Verdict::none());
  EXPECT_GT(plain.p_held_out, 1e-4);
  for (std::size_t i = 3600; i < 4000; ++i) series.heading_deg[i] += 2.0;
  const auto named = diagnose(series, {});
  EXPECT_EQ(named.verdict.text(), "magnetic_bursts");
  EXPECT_TRUE(named.other_part_held_out);
  EXPECT_GT(named.p_held_out, 1e-4);
  EXPECT_THAT(answer(named), testing::HasSubstr("another was held back in its place"));
  const auto passed = diagnose(series, nameless);
  EXPECT_FALSE(passed.other_part_held_out);
  EXPECT_EQ(passed.p_after, plain.p_after);
  EXPECT_LT(passed.p_held_out, 1e-4);
  EXPECT_EQ(passed.verdict, Verdict::unknown());
  EXPECT_THAT(passed.verdict_set, testing::ElementsAre(Verdict::unknown()));
  EXPECT_FALSE(passed.next.what.empty());
  EXPECT_THAT(answer(passed), testing::HasSubstr("held back, and not in the rest"));
}

TEST(Diagnosis, TheHeldOutPartChangesNeitherFitNorChoice) {
  Scenario s = still();
  s.sampling.duration_s = 1200.5;  // no multiple of a cluster
  s.effects = {effects::Outliers{0.005, 0.5}};
  const Series series = recorded(s, 5, false);
  Series other = series;
  const NormalStream noise(6, 0, "other");
  const Conditions conditions(series);
  for (const auto& span : conditions.spans(Part::held_out))
    for (std::size_t i = span.first; i < span.last; ++i)
      other.gyro_dps[i] += 0.02 * noise.normal(i);
  const auto a = diagnose(series, {}), b = diagnose(other, {});
  const Json left = to_json(a), right = to_json(b);
  EXPECT_EQ(left["baseline"], right["baseline"]);
  EXPECT_EQ(left["where"], right["where"]);
  EXPECT_EQ(left["verdict"], right["verdict"]);
  EXPECT_EQ(left["verdict_set"], right["verdict_set"]);
  EXPECT_EQ(left["gap"]["p_before"], right["gap"]["p_before"]);
  ASSERT_EQ(a.causes.size(), b.causes.size());
  for (std::size_t k = 0; k < a.causes.size(); ++k) {
    EXPECT_EQ(left["causes"][k]["effect"], right["causes"][k]["effect"]);
    EXPECT_EQ(left["causes"][k]["probability"], right["causes"][k]["probability"]);
    EXPECT_EQ(left["causes"][k]["parameters"], right["causes"][k]["parameters"]);
  }
  EXPECT_NE(left["gap"]["before"], right["gap"]["before"]);
}

TEST(Diagnosis, JudgesACauseThatWasFoundElsewhere) {
  Scenario s = still();
  s.effects = {effects::Outliers{0.005, 0.5}};
  const auto judged = [&](const effects::Outliers& claimed) {
    DiagnosisOptions options;
    options.claim = s;
    options.claim->effects = {claimed};
    return diagnose(recorded(s, 31, false), options);
  };
  const auto right = judged({0.005, 0.5}), wrong = judged({0.0001, 0.1});
  EXPECT_TRUE(right.claimed);
  EXPECT_EQ(right.verdict.text(), "outliers");
  EXPECT_GT(right.closed, 0.8);
  EXPECT_LT(wrong.closed, 0.3);
  const auto rules_out_unknown = [](const Diagnosis& d) {
    return std::find(d.verdict_set.begin(), d.verdict_set.end(), Verdict::unknown()) ==
           d.verdict_set.end();
  };
  EXPECT_TRUE(rules_out_unknown(right));
  EXPECT_FALSE(rules_out_unknown(wrong));
  EXPECT_FALSE(wrong.next.what.empty());
}

TEST(Diagnosis, WhatHasNoNameIsNoVerdictBesideACause) {
  Scenario s = still();
  s.sampling.duration_s = 400.0;
  s.effects = {effects::EmpiricalNoise{.reflection_1 = -0.5}, effects::Outliers{0.005, 0.5}};
  DiagnosisOptions options;
  options.claim = s;
  EXPECT_EQ(diagnose(recorded(s, 33, false), options).verdict.text(), "outliers");
}

TEST(Diagnosis, AClaimedColourOfTheCompassIsAllItsNoise) {
  Scenario s = still();
  s.compass.noise_std_deg = 0.0;
  s.effects = {effects::EmpiricalCompassNoise{.innovation_std_deg = 0.3, .reflection_1 = -0.7}};
  DiagnosisOptions options;
  options.claim = s;
  const auto right = diagnose(recorded(s, 32, true), options);
  EXPECT_GT(right.closed, 0.8);
  EXPECT_GT(right.p_after, 1e-4);  // one in ten thousand of its own recordings
}

TEST(Diagnosis, IsTheSameForAnyNumberOfThreads) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::ScaleFactor{0.01}};
  const Series series = recorded(s, 8, true);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return to_json(diagnose(series, {})).dump();
  };
  EXPECT_EQ(with(1), with(4));
}

struct Known {
  std::string name;
  Effect effect;
  bool moves;
  double duration_s = ten_minutes_s;
};

class StrongEffect : public testing::TestWithParam<Known> {};

// In 600 s at 20 Hz these effects are seven times the noise of the lens that sees them best, in
// 1200 s ten times.
TEST_P(StrongEffect, IsNamedAndClosesTheGap) {
  const double duration_s = GetParam().duration_s;
  Scenario s = GetParam().moves ? moving(duration_s) : still(duration_s);
  s.effects = {GetParam().effect};
  const auto d = diagnose(recorded(s, 12, GetParam().moves), {});
  EXPECT_EQ(d.verdict.text(), GetParam().name);
  EXPECT_LT(d.p_before, 0.01);
  EXPECT_GT(d.closed, 0.5);
}

INSTANTIATE_TEST_SUITE_P(
    Diagnosis, StrongEffect,
    testing::Values(Known{"outliers", effects::Outliers{0.005, 0.5}, false},
                    Known{"quantization", effects::Quantization{0.1}, false},
                    Known{"noise_bandwidth", effects::NoiseBandwidth{2.0}, false},
                    Known{"thermal_hysteresis", effects::ThermalHysteresis{0.08, 3.0}, false},
                    Known{"stale_samples", effects::StaleSamples{0.05, 1.0}, false,
                          twenty_minutes_s},
                    Known{"magnetic_bursts", effects::MagneticBursts{25.0, 20.0, 5.0}, false},
                    Known{"scale_factor", effects::ScaleFactor{0.01}, true},
                    Known{"dead_zone", effects::DeadZone{2.0}, true},
                    Known{"hard_iron", effects::HardIron{5.0, 40.0}, true}),
    [](const auto& known) { return known.param.name; });

TEST(Diagnosis, NamesNothingElseWhenTheCauseIsNotInTheCatalogue) {
  Scenario s = still(ten_minutes_s);
  s.effects = {effects::Quantization{0.1}};
  DiagnosisOptions options;
  options.without = {"quantization"};
  const auto d = diagnose(recorded(s, 12, false), options);
  EXPECT_TRUE(d.verdict.is_unknown()) << d.verdict.text();
}

/// Whatever is named, a recording that it misses has `unknown` beside it, and something to record
/// next.
TEST(Diagnosis, ANameThatMissesTheRecordingIsNotAlone) {
  Scenario s = still();
  s.effects = {effects::Sinusoidal{.amplitude_dps = 0.02, .frequency_hz = 0.3}};
  DiagnosisOptions options;
  options.without = {"sinusoidal"};
  const auto d = diagnose(recorded(s, 12, false), options);
  const bool has_unknown = std::find(d.verdict_set.begin(), d.verdict_set.end(),
                                     Verdict::unknown()) != d.verdict_set.end();
  EXPECT_FALSE(d.effects.empty());
  EXPECT_LT(d.p_after, 0.01);
  EXPECT_TRUE(has_unknown);
  EXPECT_FALSE(d.next.what.empty());
}

/// A neighbour takes up part of what is left out, and what it leaves of it follows the temperature
/// by branch as no noise does: more than a form of nature's own would leave.
TEST(Diagnosis, WhereTheLikelihoodSeesMoreThanAFormUnknownIsFirst) {
  Scenario s = still(ten_minutes_s);
  s.effects = {effects::ThermalHysteresis{0.08, 3.0}};
  DiagnosisOptions options;
  options.without = {"thermal_hysteresis"};
  const auto without = diagnose(recorded(s, 12, false), options);
  EXPECT_LT(p_of_the_oddest(without.unexplained), 1e-3);
  EXPECT_TRUE(without.verdict.is_unknown()) << without.verdict.text();
  const auto with = diagnose(recorded(s, 12, false), {});
  EXPECT_TRUE(with.verdict.names("thermal_hysteresis")) << with.verdict.text();
}

/// Of twenty recordings without effects the set that the likelihood finds, and the verdict on five
/// of them. Eight of 300 others have an effect named (3 %, standard error 1 %): four of twenty have
/// once in 370 families, and three of five verdicts are alarms in fewer. The published check has
/// 180 of them.
TEST(Diagnosis, FindsNothingWhereThereIsNoGap) {
  int named = 0, alarms = 0;
  for (std::uint64_t seed = 500; seed < 520; ++seed) {
    const Series series = recorded(still(ten_minutes_s), seed, false);
    if (seed < 505) {
      const auto d = diagnose(series, {});
      named += d.effects.empty() ? 0 : 1;
      alarms += d.verdict.is_none() ? 0 : 1;
    } else {
      named += find_set(Simulator(series, 1), series, {}).members.empty() ? 0 : 1;
    }
  }
  EXPECT_LT(named, 4);
  EXPECT_LT(alarms, 3);
}

TEST(Diagnosis, SaysWhatItCannotAssess) {
  Scenario s = still();
  s.sampling.duration_s = 300.0;
  s.temperature = temperature::QuietRoom{.start_C = 25.0, .end_C = 25.5};
  Series series = recorded(s, 3, false);
  series.heading_deg.clear();
  const auto d = diagnose(series, {});
  const auto why = [&](const std::string& effect) -> std::string {
    for (const auto& n : d.not_assessable)
      if (n.effect == effect) return n.why;
    return "assessed";
  };
  EXPECT_THAT(why("thermal_hysteresis"), testing::HasSubstr("at least 1 °C"));
  EXPECT_THAT(why("scale_factor"), testing::HasSubstr("rate_ref_dps"));
  EXPECT_THAT(why("hard_iron"), testing::HasSubstr("heading_deg"));
  EXPECT_THAT(why("bias_instability"), testing::HasSubstr("at least 600 s"));
  EXPECT_EQ(why("outliers"), "assessed");
}

TEST(Diagnosis, RefusesWhatHoldsNothing) {
  Series few;
  few.t_s = {0.0, 0.1};
  few.gyro_dps = {0.0, 1.0};
  EXPECT_THROW(diagnose(few, {}), InputError);
  Series constant;
  constant.t_s = {-0.1};
  constant.gyro_dps = {no_value};
  for (int i = 0; i < 2000; ++i) {
    constant.t_s.push_back(0.1 * i);
    constant.gyro_dps.push_back(1.0);
  }
  EXPECT_THROW(diagnose(constant, {}), InputError);
}

/// Eight deviations that decay in half a second: 8^2 / 4 x 10 = 160 nats for who knows where, in
/// either part of a recording.
TEST(Diagnosis, AKnockIsUnknownAndToldWhen) {
  for (const double at_s : {520.0, 400.0}) {
    auto series = recorded(still(ten_minutes_s), 31, false);
    for (std::size_t i = 0; i < series.size(); ++i)
      if (const double since_s = series.t_s[i] - at_s; since_s >= 0.0)
        series.gyro_dps[i] += 0.4 * std::exp(-2.0 * since_s) * std::sin(38.0 * since_s);
    const auto d = diagnose(series, {});
    EXPECT_TRUE(d.verdict.is_unknown()) << d.verdict.text();
    ASSERT_TRUE(d.transient);
    EXPECT_LT(d.transient->from_s, at_s + 0.5);
    EXPECT_GT(d.transient->to_s, at_s);
    EXPECT_NEAR(d.transient->frequency_hz, 6.0, 1.0);
    EXPECT_TRUE(to_json(d)["remainder"].contains("transient"));
    EXPECT_THAT(next_in_words(d), testing::HasSubstr("once more"));
  }
}

TEST(Diagnosis, TheJsonKeepsTheContract) {
  const Json json = to_json(diagnose(recorded(still(), 21, false), {}));
  for (const char* key : {"recording", "baseline", "where", "gap", "causes", "verdict",
                          "verdict_set", "steps", "not_assessable", "transfer", "next_experiment"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"before", "after", "closed", "closed_interval", "p_before", "p_after"})
    EXPECT_TRUE(json["gap"].contains(key)) << key;
}

TEST(Diagnosis, ToldSharesOnlyGrowAndEndAtOne) {
  Scenario s = still();
  s.sampling.duration_s = 300.0;
  s.effects = {effects::Outliers{0.01, 0.5}};
  std::vector<double> shares;
  diagnose(recorded(s, 41, false), {}, [&](const auto& now) { shares.push_back(now.share); });
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_GT(shares.size(), 10U);
}

// Whatever it is at, and with what is running on other threads.
TEST(Diagnosis, EndsWhereverItIsInterrupted) {
  Scenario s = still();
  s.sampling.duration_s = 120.0;
  s.effects = {effects::Outliers{0.01, 0.5}, effects::Vibration{0.1, 4.0, 0.5}};
  const Series series = recorded(s, 42, false);
  std::size_t all = 0;
  diagnose(series, {}, [&](const auto&) { ++all; });
  for (std::size_t at = 0; at + 1 < all; at += std::max<std::size_t>(1, all / 12)) {
    std::atomic<bool> stop{false};
    std::size_t told = 0;
    // How often it tells depends on the threads: a later moment may not come.
    const auto stopping = [&](const DiagnosisStage& now) {
      EXPECT_FALSE(stop) << at;
      stop = told++ == at && now.share < 1.0;
    };
    bool interrupted = false;
    try {
      diagnose(series, {}, stopping, Interrupt(stop));
    } catch (const Interrupted&) {
      interrupted = true;
    }
    EXPECT_EQ(interrupted, stop.load()) << at;
  }
}

}  // namespace
}  // namespace gyrostat::gap::diagnosis_test
