#include <gyrostat/experiments/findings/consistency.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::consistency_test {
namespace {

using testing::HasSubstr;

Method told_the_truth(const std::string& id, const std::string& filter,
                      const ParameterMap& overrides = {}) {
  Method method;
  method.id = id;
  method.filter = filter;
  method.source = ParameterSource::truth;
  method.overrides = overrides;
  return method;
}

constexpr double noise_std = 0.05;

/// A gyro without moving average, so that the KF's model is true: told the truth, its noise's
/// variance halved, and doubled.
Cell cell() {
  Cell cell;
  cell.name = "true model";
  cell.trials = 400;
  cell.scenario.sampling = {.duration_s = 20.0, .rate_hz = 20.0};
  cell.scenario.random_error = {
      .phi = 0.3, .delta1_dps = 0.01, .delta2_dps = 0.0, .measurement_noise_std_dps = noise_std};
  const double less = noise_std / std::sqrt(2.0), more = noise_std * std::sqrt(2.0);
  cell.methods = {told_the_truth("none", "none"), told_the_truth("kf", "kf"),
                  told_the_truth("oracle", "oracle"),
                  told_the_truth("half_r", "kf", {{"measurement_noise_std_dps", less}}),
                  told_the_truth("twice_r", "kf", {{"measurement_noise_std_dps", more}})};
  return cell;
}

class Consistency : public testing::Test {
 protected:
  static const std::vector<ConsistencyTest>& tests() {
    static const auto all = [] {
      const auto result = run_cell(cell(), 31, {});
      const auto summary = summarise_cell(cell(), [&](const auto& visit) {
        for (std::uint32_t t = 0; t < result.trials.size(); ++t)
          visit(true, row_of(0, t, *result.trials[t]).outcomes);
      });
      return consistency_tests(cell(), summary);
    }();
    return all;
  }
  static const ConsistencyTest& test(const std::string& method, const std::string& name) {
    for (const auto& t : tests())
      if (t.method == method && t.test == name) return t;
    throw std::logic_error("no such test: " + method + " " + name);
  }
};

/// All tests of all methods together err with a probability of 5 %; those of two methods, which are
/// one filter here, with 1 % (seven of thirty-five tests).
TEST_F(Consistency, AFilterWhoseModelIsTrueIsConsistentInEveryTest) {
  for (const char* method : {"kf", "oracle"}) {
    for (const char* name : {"nis", "pit", "nees", "nees_end", "within_3_sigma"})
      EXPECT_EQ(test(method, name).verdict, "consistent")
          << method << ' ' << name << ' ' << test(method, name).value;
    EXPECT_EQ(test(method, "lag_1").verdict, "white");
    EXPECT_EQ(test(method, "ljung_box").verdict, "white");
  }
}

TEST_F(Consistency, AFilterThatHalvesTheNoiseIsOverConfident) {
  for (const char* name : {"nis", "pit", "nees", "within_3_sigma"})
    EXPECT_EQ(test("half_r", name).verdict, "over-confident") << name;
  EXPECT_EQ(test("half_r", "lag_1").verdict, "correlated");
}

TEST_F(Consistency, AFilterThatDoublesTheNoiseIsConservative) {
  for (const char* name : {"nis", "pit", "nees", "within_3_sigma"})
    EXPECT_EQ(test("twice_r", name).verdict, "conservative") << name;
}

TEST_F(Consistency, NoFilterStatesNothing) {
  for (const char* name : {"nis", "lag_1", "pit", "nees"})
    EXPECT_EQ(test("none", name).verdict, "–") << name;
}

TEST(ConsistencyVerb, PrintsBoundsAndHistograms) {
  const TestFolder folder;
  folder.write("s.json", R"({"cells": [{"name": "c", "trials": 20, "parameters_from": "truth",
    "scenario": {"duration_s": 10, "rate_hz": 20}, "filters": ["none", "kf", "oracle"]}]})");
  ASSERT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
  const auto ended = run_program(folder, {"consistency", "runs/s"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("ljung_box"));
  EXPECT_THAT(ended.out, HasSubstr("0–10 %"));
}

}  // namespace
}  // namespace gyrostat::consistency_test
