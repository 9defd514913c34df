// Rules that recordings are watched by.

#include <gyrostat/experiments/findings/health.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat::gap::health_test {
namespace {

using testing::HasSubstr;

Diagnosis sick() {
  Diagnosis d;
  d.gap_before = 3.0;
  d.gap_after = 1.0;
  d.p_before = 0.001;
  d.p_after = 0.4;
  d.effects.push_back(
      {.effect = "vibration", .inclusion = 0.97, .parameters = {}, .intervals = {}});
  return d;
}

bool breaks(const Diagnosis& d, const char* rule) {
  return HealthRule(rule, "test").is_broken_by(d);
}

TEST(HealthRule, HoldsANumberToALimit) {
  const auto d = sick();
  EXPECT_TRUE(breaks(d, "gap>2"));
  EXPECT_FALSE(breaks(d, "gap > 3"));
  EXPECT_TRUE(breaks(d, " gap >= 3 "));
  EXPECT_TRUE(breaks(d, "p<1e-2"));
  EXPECT_FALSE(breaks(d, "p<=1e-4"));
  EXPECT_TRUE(breaks(d, "left<=1"));
  EXPECT_TRUE(breaks(d, "effects>=1"));
  EXPECT_TRUE(breaks(d, "vibration>0.9"));
  EXPECT_FALSE(breaks(d, "quantization>0.5"));  // it is not there
  EXPECT_EQ(HealthRule("gap>2", "test").told(d), "gap>2 holds: gap is 3 spreads");
}

TEST(HealthRule, OfABaselineIsAboutTheBaseline) {
  auto d = sick();
  d.claimed = true;
  EXPECT_FALSE(breaks(d, "gap>2"));
  EXPECT_FALSE(breaks(d, "p<0.02"));
}

TEST(HealthRule, WhatCannotBeToldIsNotHealthy) {
  auto d = sick();
  d.gap_before = no_value;
  EXPECT_TRUE(breaks(d, "gap>2"));
  EXPECT_TRUE(breaks(d, "gap<2"));
}

TEST(HealthRule, AMistakeIsToldWithWhatIsAllowed) {
  const auto told = [](const char* rule) -> std::string {
    try {
      const HealthRule wrong(rule, "--fail-if");
    } catch (const InputError& mistake) {
      return mistake.what();
    }
    return "";
  };
  EXPECT_THAT(told("gap"), HasSubstr("is no rule; allowed"));
  EXPECT_THAT(told("gap>high"), HasSubstr("the limit 'high' is not a number"));
  EXPECT_THAT(told("gap>nan"), HasSubstr("is not a number"));
  EXPECT_THAT(told("vibraton>0.5"), HasSubstr("is it 'vibration'?"));
  EXPECT_THAT(told("gaps>2"), HasSubstr("is it 'gap'?"));
  EXPECT_THAT(told(""), HasSubstr("is no rule"));
  EXPECT_THAT(told(">2"), HasSubstr("there is no number ''"));
}

TEST(HealthJson, HasEachNumberAndWhatFailed) {
  const auto json = health_json(sick(), {HealthRule("gap>2", "t"), HealthRule("gap>4", "t")});
  EXPECT_EQ(json.at("gap"), 3.0);
  EXPECT_EQ(json.at("found").at("vibration"), 0.97);
  EXPECT_EQ(json.at("failed"), nlohmann::ordered_json::array({"gap>2"}));
}

}  // namespace
}  // namespace gyrostat::gap::health_test
