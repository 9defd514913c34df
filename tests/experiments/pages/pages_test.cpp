#include <algorithm>

#include <gmock/gmock.h>

#include <gyrostat/tests/program.hpp>

namespace gyrostat::pages_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Ten seconds of a random walk in white noise, which the oracle knows and "none" does not.
constexpr const char* study = R"({"cells": [
  {"name": "quiet", "trials": 30, "parameters_from": "truth",
   "scenario": {"duration_s": 10, "rate_hz": 20, "random_error": {"phi": 0, "delta1_dps": 0.01, "delta2_dps": 0, "measurement_noise_std_dps": 0.01}},
   "filters": ["none", "kf", {"id": "again", "filter": "kf"}, "oracle"]},
  {"name": "loud", "trials": 30, "parameters_from": "truth",
   "scenario": {"duration_s": 10, "rate_hz": 20, "random_error": {"phi": 0, "delta1_dps": 0.01, "delta2_dps": 0, "measurement_noise_std_dps": 0.1}},
   "filters": ["none", "kf", {"id": "again", "filter": "kf"}, "oracle"]}]})";

std::string ledger_of(const std::string& claim) {
  return R"({"title": "t", "claims": [{"claim": "c", "study": "study.json", )" + claim + "}]}";
}

Ended ledger(const std::string& claim) {
  const TestFolder folder;
  folder.write("study.json", study);
  folder.write("ledger.json", ledger_of(claim));
  return run_program(folder, {"ledger", "ledger.json", "--format", "csv"});
}

/// The first row of the claims: its last cell is the verdict.
std::string verdict(const std::string& claim) {
  const auto ended = ledger(claim);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto start = ended.out.find("\nc,");
  const auto row = ended.out.substr(start + 1, ended.out.find('\n', start + 1) - start - 1);
  return row.substr(row.find_last_of(row.ends_with('"') ? "\"" : ",", row.size() - 2) + 1);
}

TEST(Ledger, DecidesWhatIsKnown) {
  EXPECT_EQ(verdict(R"("method": "oracle", "than": "none", "metric": "bias_rmse")"), "holds");
  EXPECT_EQ(verdict(R"("method": "none", "than": "oracle", "metric": "bias_rmse")"),
            "does not hold");
  EXPECT_EQ(verdict(R"("method": "none", "than": "oracle", "metric": "bias_rmse", "above": 1)"),
            "holds");
  EXPECT_EQ(verdict(R"("method": "kf", "than": "again", "metric": "bias_rmse")"), "equal");
  EXPECT_EQ(verdict(R"("method": "none", "metric": "rate_std", "value": 1)"), "holds");
  EXPECT_EQ(verdict(R"("method": "oracle", "metric": "rate_std", "value": 0.05)"),
            "holds only in quiet");
}

TEST(Ledger, ComparesCellsByTheirTrials) {
  EXPECT_EQ(
      verdict(R"("method": "kf", "metric": "bias_rmse", "cells": ["quiet"], "than_cell": "loud")"),
      "holds");
  EXPECT_EQ(
      verdict(
          R"("method": "none", "metric": "bias_rmse", "cells": ["quiet"], "than_cell": "loud")"),
      "equal");  // the random error is the same, draw by draw
}

void expect_one_line(const Ended& ended, const std::string& naming) {
  EXPECT_EQ(ended.exit_code, 2) << naming;
  EXPECT_THAT(ended.err, HasSubstr(naming));
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
}

TEST(Ledger, NamesEveryMistakeInOneLine) {
  expect_one_line(ledger(R"("method": "kf", "metric": "bias_rms")"), "bias_rmse");
  expect_one_line(ledger(R"("method": "kff", "metric": "bias_rmse")"), "no method 'kff'");
  expect_one_line(ledger(R"("method": "kf", "than": "x", "metric": "bias_rmse")"), "no method 'x'");
  expect_one_line(ledger(R"("method": "kf", "metric": "bias_rmse", "cells": ["quite"])"), "quiet");
  expect_one_line(ledger(R"("method": "kf", "metric": "bias_rmse", "cells": [1])"), "cells[0]");
  expect_one_line(ledger(R"("method": "kf", "metric": "bias_rmse", "than_cell": "lod")"), "loud");
  expect_one_line(ledger(R"("method": "kf", "metric": "bias_rmse", "absolut": 1)"), "absolute");
  const TestFolder folder;
  folder.write("ledger.json", R"({"claims": []})");
  expect_one_line(run_program(folder, {"ledger", "ledger.json"}), "claims");
  expect_one_line(run_program(folder, {"ledger", "nothing.json"}), "no such file");
}

constexpr const char* target =
    R"("free": [{"path": "scenario.random_error.measurement_noise_std_dps", "low": 0.001, "high": 1}],
       "targets": [{"cell": "quiet", "method": "none", "metric": "rate_std", "value": 0.2, "tolerance": 0.025}])";

Ended match(const std::string& keys, const char* with = study) {
  const TestFolder folder;
  folder.write("study.json", with);
  folder.write(
      "match.json",
      R"({"study": "study.json", "trials": 4, "evaluations": 40, "rounds": 1, )" + keys + "}");
  return run_program(folder, {"match", "match.json", "--format", "csv"});
}

/// 0.2 dps of rate is nearly all white noise: the walk adds 0.01 sqrt(200 / 6) in quadrature. The
/// tolerances are three standard errors of the mean of four trials.
TEST(Match, FindsTheNoiseBehindAPublishedNumber) {
  const auto ended = match(target);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("1 of 1 within their tolerance"));
  const auto row = ended.out.find("measurement_noise_std_dps,");
  EXPECT_NEAR(std::stod(ended.out.substr(row + 26)), 0.19, 0.03);
}

TEST(Match, IsTheSameEveryTime) { EXPECT_EQ(match(target).out, match(target).out); }

TEST(Match, NamesEveryMistakeInOneLine) {
  const auto targets = [](const std::string& t) { return R"("free": [], "targets": [)" + t + "]"; };
  expect_one_line(match(targets("")), "targets");
  expect_one_line(match(targets(R"({"cell": "quit", "method": "none", "metric": "rate_std"})")),
                  "quiet");
  expect_one_line(match(targets(R"({"cell": "quiet", "method": "nine", "metric": "rate_std"})")),
                  "none");
  expect_one_line(match(targets(R"({"cell": "quiet", "method": "none", "metric": "rate"})")),
                  "rate");
  expect_one_line(
      match(
          targets(R"({"cell": "quiet", "method": "none", "metric": "rate_std", "tolerance": 0})")),
      "tolerance");
  expect_one_line(match(R"("free": [{"path": "trials", "low": 2, "high": 1}], "targets": [])"),
                  "low");
  expect_one_line(match(std::string(target) + R"(, "tirals": 3)"), "trials");
}

std::string tuned_study(const std::string& tune) {
  return R"({"cells": [{"name": "a", "trials": 8, "parameters_from": "truth", "assumed": {"delta1_dps": 30},
    "scenario": {"duration_s": 20, "rate_hz": 20, "random_error": {"phi": 0, "delta1_dps": 0.01, "delta2_dps": 0, "measurement_noise_std_dps": 0.1}},
    "tuning": {"trials": 10, "evaluations": 40},
    "filters": ["kf", {"id": "tuned", "filter": "kf", "tune": )" +
         tune + R"(}, "kf_ma"]}]})";
}

Ended run_tuned(const std::string& tune, const std::string& threads = "2") {
  const TestFolder folder;
  folder.write("study.json", tuned_study(tune));
  return run_program(folder,
                     {"run", "study.json", "--format", "csv", "--out", "o", "--threads", threads});
}

/// delta1 told thirty times too large, tuned back to 0.01 within the flatness of the optimum.
TEST(Tuning, FindsTheOptimumOfAKnownCase) {
  const auto ended = run_tuned(R"({"delta1_dps": [0.0001, 1]})");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto row = ended.out.find("tuned,delta1_dps,");
  ASSERT_NE(row, std::string::npos);
  EXPECT_NEAR(std::stod(ended.out.substr(row + 17)), 0.01, 0.004);
}

TEST(Tuning, IsTheSameOnOneThreadAndEight) {
  const std::string tune = R"({"delta1_dps": [0.0001, 1], "measurement_noise_std_dps": [0.01, 1]})";
  EXPECT_EQ(run_tuned(tune, "1").out, run_tuned(tune, "8").out);
}

TEST(Tuning, NamesEveryMistakeInOneLine) {
  expect_one_line(run_tuned(R"({"delta1_dps": [1]})"), "delta1_dps");
  expect_one_line(run_tuned(R"({"delta1_dps": [2, 1]})"), "lower bound");
  expect_one_line(run_tuned(R"({"delta1_dps": [-1, 1]})"), "out of range");
  expect_one_line(run_tuned(R"({"delta_1": [0, 1]})"), "delta1_dps");
}

Ended validate_grid(const std::string& grid) {
  const TestFolder folder;
  folder.write("study.json",
               R"({"cells": [{"name": "g", "trials": 2, "filters": ["none"], "scenario":
    {"effects": [{"effect": "outliers"}]}, "grid": )" +
                   grid + "}]}");
  return run_program(folder, {"validate", "study.json"});
}

TEST(Grid, IsEveryCombinationUnderAName) {
  const auto ended = validate_grid(
      R"({"scenario.duration_s": [1, 2], "scenario.effects.0.std_dps": [0.5, 1, 2]})");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* name : {"g[duration_s=1,std_dps=0.5]: 2 trials of 100 samples",
                           "g[duration_s=2,std_dps=2]: 2 trials of 200 samples"})
    EXPECT_THAT(ended.out, HasSubstr(name));
  EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 7);
}

TEST(Grid, NamesEveryMistakeInOneLine) {
  expect_one_line(validate_grid("[1]"), "grid");
  expect_one_line(validate_grid(R"({"scenario.duration_s": []})"), "list of values");
  expect_one_line(validate_grid(R"({"scenario.effects.3.std_dps": [1]})"), "index");
  expect_one_line(validate_grid(R"({"scenario.duration_s.x": [1], "trials": [1]})"),
                  "scenario.duration_s");
  expect_one_line(validate_grid(R"({"scenario.duration": [1]})"), "duration_s");
}

class Publish : public testing::Test {
 protected:
  Publish() {
    folder.write("study.json", study);
    folder.write("page/page.json",
                 page_of(R"({"name": "errors", "kind": "means", "cells": ["quiet"]})"));
    folder.write("page/page.md",
                 "The oracle: {{errors | quiet / oracle | bias_rmse}} dps.\n\n{{table errors}}\n");
  }
  static std::string page_of(const std::string& table) {
    return R"({"sources": [{"study": "../study.json", "tables": [)" + table + "]}]}";
  }
  Ended publish(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"publish", "page"});
    return run_program(folder, more);
  }
  void expect_mistake(const std::string& table, const std::string& naming) const {
    folder.write("page/page.json", page_of(table));
    expect_one_line(publish(), naming);
  }
  TestFolder folder;
};

TEST_F(Publish, FillsInTheTextFromTheData) {
  ASSERT_EQ(publish().exit_code, 0);
  const auto text = folder.read("page/README.md");
  EXPECT_THAT(text, HasSubstr("The oracle: 0.00"));
  EXPECT_THAT(text, HasSubstr("| quiet | kf |"));
  EXPECT_THAT(text, Not(HasSubstr("{{")));
  EXPECT_EQ(publish({"--check"}).exit_code, 0);
}

TEST_F(Publish, MakesTheSameBytesOnOneThreadAndEight) {
  ASSERT_EQ(publish({"--threads", "1", "--out", "one"}).exit_code, 0);
  ASSERT_EQ(publish({"--threads", "8", "--out", "eight"}).exit_code, 0);
  for (const char* file : {"README.md", "errors.csv", "tables.json"})
    EXPECT_EQ(folder.read(std::string("one/") + file), folder.read(std::string("eight/") + file));
}

TEST_F(Publish, TheCheckFindsTextThatDisagreesWithTheData) {
  ASSERT_EQ(publish().exit_code, 0);
  folder.write("page/README.md", folder.read("page/README.md") + "x");
  EXPECT_EQ(publish({"--check"}).exit_code, 1);
  ASSERT_EQ(publish({"--text"}).exit_code, 0);
  EXPECT_EQ(publish({"--check"}).exit_code, 0);
  folder.write("page/errors.csv", "other\n");
  const auto ended = publish({"--check"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("errors.csv"));
}

TEST_F(Publish, MakesEveryKindOfTable) {
  const std::string of =
      R"(", "cells": ["quiet", "loud"], "methods": ["none", "kf"], "than": ["oracle"]})";
  for (const char* kind : {"means", "map", "versus", "traces", "allan", "tuned"}) {
    folder.write("page/page.json",
                 page_of(std::string(R"({"name": "errors", "kind": ")") + kind + of));
    folder.write("page/page.md", "{{table errors}}\n");
    EXPECT_EQ(publish().exit_code, 0) << kind;
  }
}

TEST_F(Publish, DrawsTheSameFigureFromTheSameData) {
  folder.write("page/page.json", R"({"sources": [{"study": "../study.json", "tables": [
    {"name": "trace", "kind": "traces", "cells": ["quiet"], "points": 20}, {"name": "errors", "kind": "map"}]}],
    "figures": [{"name": "f", "kind": "lines", "table": "trace", "methods": ["none", "kf"], "panels": 1},
                {"name": "g", "kind": "heat", "table": "errors", "methods": ["none", "kf", "oracle"]}]})");
  folder.write("page/page.md", "x\n");
  ASSERT_EQ(publish().exit_code, 0);
  for (const char* file : {"page/f.svg", "page/g.svg"})
    EXPECT_THAT(folder.read(file), HasSubstr("</svg>"));
  EXPECT_THAT(folder.read("page/f.svg"), Not(HasSubstr("nan")));
  EXPECT_EQ(publish({"--check"}).exit_code, 0);
}

TEST_F(Publish, NamesEveryMistakeInOneLine) {
  expect_mistake(R"({"kind": "means"})", "name");
  expect_mistake(R"({"name": "errors", "kind": "mean"})", "means");
  expect_mistake(R"({"name": "errors", "kind": "means", "cells": ["quite"]})", "quiet");
  expect_mistake(R"({"name": "errors", "kind": "means", "metrics": ["bias"]})", "bias");
  expect_mistake(R"({"name": "errors", "kind": "means", "methods": ["nine"]})", "none");
  expect_mistake(R"({"name": "errors", "kind": "means", "metric": "nis"})", "metrics");
  folder.write("page/page.json", page_of(R"({"name": "errors", "kind": "means"})"));
  for (const char* mark :
       {"{{errors | quiet / oracl | bias_rmse}}", "{{errors | quiet / kf | bias}}",
        "{{errors | quiet}}", "{{error | quiet / kf | bias_rmse}}",
        "{{nowhere: errors | quiet / kf | bias_rmse}}", "{{table errors"}) {
    folder.write("page/page.md", mark);
    const auto ended = publish();
    EXPECT_EQ(ended.exit_code, 2) << mark << ended.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "page/README.md"));
  }
  expect_one_line(publish({"--text", "--trials", "3"}), "--trials");
  expect_one_line(run_program(folder, {"publish", "nowhere"}), "no such file");
}

/// What is denoised is the rate that the error is judged by, not what the filters see.
TEST(Denoising, MakesTheJudgedRateQuieterAndLeavesTheEstimateAlone) {
  const TestFolder folder;
  const auto cell = [](const char* name, const char* more) {
    return std::string(R"({"name": ")") + name + R"(", "trials": 3, "parameters_from": "truth", )" +
           more +
           R"("scenario": {"duration_s": 60, "rate_hz": 10, "random_error": {"phi": 0, "delta1_dps": 0.001, "delta2_dps": 0, "measurement_noise_std_dps": 0.1},
              "motion": {"profile": "sinusoidal"}}, "filters": ["oracle"]})";
  };
  folder.write("study.json", R"({"cells": [)" + cell("raw", "") + "," +
                                 cell("denoised", R"("denoise": 1, )") + "]}");
  folder.write("ledger.json", R"({"claims": [
    {"claim": "quieter", "study": "study.json", "cells": ["denoised"], "method": "oracle", "metric": "rate_std", "value": 0.03},
    {"claim": "loud", "study": "study.json", "cells": ["raw"], "method": "oracle", "metric": "rate_std", "value": 0.09, "above": 1},
    {"claim": "alike", "study": "study.json", "cells": ["denoised"], "than_cell": "raw", "method": "oracle", "metric": "bias_rmse"}]})");
  const auto out = run_program(folder, {"ledger", "ledger.json", "--format", "csv"}).out;
  EXPECT_THAT(out, HasSubstr("below 0.03,"));
  EXPECT_THAT(out.substr(0, out.find("findings")), Not(HasSubstr("does not hold")));
  EXPECT_THAT(out, HasSubstr("its own in raw,0,equal"));
}

}  // namespace
}  // namespace gyrostat::pages_test
