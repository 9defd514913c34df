#include <gyrostat/experiments/findings/failure_sensitivity.hpp>

#include <cmath>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/tests/program.hpp>

namespace gyrostat::failure_sensitivity_test {
namespace {

using testing::HasSubstr;

/// The heading at the end of nine steps of 1 s is Gaussian, of variance 9 R + 384 delta1^2: its
/// tail beyond 14 degrees is 1e-8 to 1e-3 over the design.
constexpr const char* study = R"({"seed": 4, "cells": [{"name": "walk", "trials": 200,
  "parameters_from": "truth", "filters": ["none", "oracle"],
  "design": {"kind": "saltelli", "rows": 24, "parameters": {
    "scenario.random_error.measurement_noise_std_dps": {"from": 0.8, "to": 1.2},
    "scenario.random_error.delta1_dps": {"from": 0.05, "to": 0.15}}},
  "scenario": {"duration_s": 10, "rate_hz": 1,
    "random_error": {"phi": 0, "delta1_dps": 0.1, "delta2_dps": 0,
                     "measurement_noise_std_dps": 1},
    "thermal_drift": {"a_dps_per_C": 0, "b_dps_s_per_C": 0, "c_dps": 0}},
  "failure": {"metric": "heading_end", "above": 14, "runs": 4, "samples": 200,
              "methods": ["none"]}}]})";

TEST(FailureSensitivity, OfAGaussianTailIsItsLaw) {
  TestFolder folder;
  folder.write("s.json", study);
  const auto ran = run_program(folder, {"run", "s.json", "--format", "md"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("matters most to log10 of the probability of failure"));

  const Store store = Store::open(folder.path() / "runs/s");
  const auto found = failure_sensitivities(parse_study(Json::parse(study), "s.json"), store,
                                           folder.path() / "runs/s");
  ASSERT_EQ(found.size(), 1U);
  const auto& s = found.front();
  EXPECT_EQ(s.method, "none");
  ASSERT_EQ(s.indices.size(), 2U);
  // Total indices by NumPy, 200,000 rows of log10 of the exact tail (Jansen's estimator): 0.530 and
  // 0.519. Four standard errors, of which the 95 % interval has 3.9: one false failure in 16,000.
  const double law[] = {0.530, 0.519};
  for (std::size_t p = 0; p < 2; ++p) {
    const auto& total = s.indices[p].total;
    EXPECT_LT(std::abs(total.value - law[p]), total.high - total.low) << s.parameters[p];
    EXPECT_LT(total.high - total.low, 1.2) << s.parameters[p];
  }
  // By the law the mean over the design is -4.46; its spread is 0.97, and rows are few.
  double mean = 0.0;
  for (const double m : s.means) mean += m / static_cast<double>(s.means.size());
  EXPECT_NEAR(mean, -4.46, 0.5);
}

TEST(FailureSensitivity, IsToldByTheVerbAndNamesWhatThereIsNot) {
  TestFolder folder;
  auto few = Json::parse(study);
  few["cells"][0]["design"] = Json::parse(
      R"({"kind": "one_at_a_time", "parameters": {"scenario.random_error.delta1_dps":
          {"from": 0.08, "to": 0.12}}})");
  folder.write("s.json", few.dump());
  ASSERT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
  const auto told = run_program(folder, {"sensitivity", "runs/s", "--metric", "failure"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("elasticities of probability of failure"));
  const auto other =
      run_program(folder, {"sensitivity", "runs/s", "--metric", "failure", "--method", "oracel"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("none"));
  few["cells"][0].erase("failure");
  folder.write("t.json", few.dump());
  ASSERT_EQ(run_program(folder, {"run", "t.json"}).exit_code, 0);
  const auto without = run_program(folder, {"sensitivity", "runs/t", "--metric", "failure"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("no cell of it asks for a failure"));
}

}  // namespace
}  // namespace gyrostat::failure_sensitivity_test
