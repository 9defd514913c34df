// The diagnosis on recordings that were handed over, real ones and those for practice.

#include <filesystem>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/tests/places.hpp>

namespace gyrostat::gap::handed_over_test {
namespace {

/// A recording that was handed over, of the gyro about `axis` where it has several; none where it
/// is not there.
std::optional<Series> handed_over(const std::string& name, const std::string& axis = "") {
  const auto path = std::filesystem::path(places::recordings()) / (name + ".csv.gz");
  if (!std::filesystem::exists(path)) return {};
  return read_recording(path.string(), axis).series;
}

/// The beginning of one for practice, which tells as much in less time: of slow errors a half, of
/// others a quarter.
std::optional<Series> practice(const std::string& name) {
  const auto series = handed_over("practice/" + name);
  if (!series) return {};
  const bool is_slow = std::regex_search(name, std::regex("gauss_markov|thermal"));
  return series->slice(0, series->size() / (is_slow ? 2 : 4));
}

/// They are named after their effect.
void expect_named(const std::string& effect) {
  const auto series = practice(effect);
  if (!series) GTEST_SKIP() << "the practice recordings are not there";
  EXPECT_EQ(diagnose(*series, {}).verdict.text(), effect);
}

/// Sets are named after where they were recorded and their effects, with a + between.
class PracticeSets : public testing::TestWithParam<std::string> {};

TEST_P(PracticeSets, AreNamedWholeAndClosed) {
  const auto series = practice("sets/" + GetParam());
  if (!series) GTEST_SKIP() << "the practice recordings are not there";
  std::set<std::string> expected, named;
  std::istringstream effects(GetParam().substr(GetParam().find("__") + 2));
  for (std::string effect; std::getline(effects, effect, '+');) expected.insert(effect);
  const auto diagnosis = diagnose(*series, {});
  for (const auto& effect : diagnosis.effects)
    if (effect.inclusion > 0.5) named.insert(effect.effect);
  EXPECT_EQ(named, expected);
  EXPECT_GT(diagnosis.closed, 0.8);
}

INSTANTIATE_TEST_SUITE_P(
    Each, PracticeSets,
    testing::Values("chamber__noise_temperature+quantization+thermal_curvature",
                    "table__compass_lag+soft_iron"),
    [](const auto& name) { return std::regex_replace(name.param, std::regex("[^a-z]+"), "_"); });

// One recording a test, so that cores share the work.
TEST(PracticeRecordings, NoneIsNamed) { expect_named("none"); }
TEST(PracticeRecordings, GaussMarkovIsNamed) { expect_named("gauss_markov"); }
TEST(PracticeRecordings, ThermalHysteresisIsNamed) { expect_named("thermal_hysteresis"); }
TEST(PracticeRecordings, ScaleFactorIsNamed) { expect_named("scale_factor"); }

/// A Xsens DOT beside which somebody knocked: a filter and errors of an angle, neither of which is
/// there, had held each other up. With both the recording was missed at p = 3e-15.
TEST(Diagnosis, TwoThatHoldEachOtherUpGoTogether) {
  const auto series = handed_over("xsens_dot_03_static", "y");
  if (!series) GTEST_SKIP() << "the recordings are not there";
  const auto d = diagnose(*series, {});
  EXPECT_TRUE(d.verdict.is_unknown()) << d.verdict.text();
  for (const auto& effect : d.effects)
    EXPECT_THAT(effect.effect, testing::AnyOf("telegraph", "gauss_markov"));
  EXPECT_GT(d.p_after, 1e-6);
  ASSERT_TRUE(d.transient);
  EXPECT_LT(d.transient->from_s, 55.2);  // the sensor beside it has it then, too
  EXPECT_GT(d.transient->to_s, 54.8);
}

/// Without a faint telegraph a broad line beside it is none by a hair: that it then has no name had
/// been odds of 9,800 nats for the telegraph.
TEST(Diagnosis, AnEffectIsNoSurerForTheNameOfAnother) {
  const auto series = handed_over("xsens_dot_02_static", "z");
  if (!series) GTEST_SKIP() << "the recordings are not there";
  const auto d = diagnose(*series, {});
  for (const auto& effect : d.effects) EXPECT_LT(effect.log_odds, 10.0) << effect.effect;
  EXPECT_GT(d.p_before, 1e-4);
}

}  // namespace
}  // namespace gyrostat::gap::handed_over_test
