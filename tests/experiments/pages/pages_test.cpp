#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

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

/// Claim, source, measured, difference, verdict and most favourable reading of the first claim of
/// a ledger with these claims, the empty ones empty.
std::vector<std::string> judged(const std::string& claims) {
  const TestFolder folder;
  folder.write("study.json", study);
  folder.write("ledger.json", R"({"title": "t", "claims": [)" + claims + "]}");
  const auto ended = run_program(folder, {"ledger", "ledger.json", "--format", "json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  std::vector<std::string> cells;
  const auto tables = nlohmann::json::parse(ended.out);
  for (const auto& cell : tables[0]["rows"][0])
    cells.push_back(cell.is_string() ? cell.get<std::string>() : "");
  return cells;
}

std::string claim_of(const std::string& keys) {
  return R"({"claim": "c", "study": "study.json", )" + keys + "}";
}

std::string verdict(const std::string& keys) { return judged(claim_of(keys))[4]; }

TEST(Match, AsksForItsStudy) {
  const TestFolder folder;
  folder.write("match.json", R"({"trials": 5})");
  const auto ended = run_program(folder, {"match", "match.json"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("match.json:"));
  EXPECT_THAT(ended.err, HasSubstr("study: is missing; required: the path of a study file"));
}

TEST(Ledger, DecidesWhatIsKnown) {
  EXPECT_EQ(verdict(R"("method": "oracle", "than": "none", "metric": "bias_rmse")"),
            "holds in these 2 scenarios");
  EXPECT_EQ(verdict(R"("method": "none", "than": "oracle", "metric": "bias_rmse")"),
            "does not hold in these 2 scenarios");
  EXPECT_EQ(verdict(R"("method": "none", "than": "oracle", "metric": "bias_rmse", "above": 1)"),
            "holds in these 2 scenarios");
  EXPECT_EQ(verdict(R"("method": "kf", "than": "again", "metric": "bias_rmse")"),
            "equal in these 2 scenarios");
  EXPECT_EQ(verdict(R"("method": "none", "metric": "rate_std", "value": 1, "cells": ["quiet"])"),
            "holds in this scenario");
  EXPECT_EQ(verdict(R"("method": "oracle", "metric": "rate_std", "value": 0.05)"),
            "holds only in quiet");
}

TEST(Ledger, ComparesCellsByTheirTrials) {
  EXPECT_EQ(
      verdict(R"("method": "kf", "metric": "bias_rmse", "cells": ["quiet"], "than_cell": "loud")"),
      "holds in this scenario");
  EXPECT_EQ(
      verdict(
          R"("method": "none", "metric": "bias_rmse", "cells": ["quiet"], "than_cell": "loud")"),
      "equal in this scenario");  // the random error is the same, draw by draw
}

/// White noise of 0.1 dps has an Allan deviation of 0.1 sqrt(0.05 s / tau) dps, that of the walk in
/// "none" only adds to it: below 0.2 at every tau, above 0.05 at the shortest alone (0.1; at 4 s
/// the two come to 0.03 dps). Thirty trials, so that a mean is known to 3 %.
TEST(Ledger, JudgesAllanDeviationsAtEachTau) {
  const std::string none = R"("method": "none", "cells": ["loud"], "allan_tau_s": [0.05, 4], )";
  EXPECT_EQ(verdict(none + R"("value": 0.2)"), "holds in these 2 scenarios");
  EXPECT_EQ(verdict(none + R"("value": 0.05, "above": 1)"), "holds only in loud at 0.05 s");
  EXPECT_EQ(verdict(R"("method": "kf", "than": "again", "allan_tau_s": [1])"),
            "equal in these 2 scenarios");
}

TEST(Ledger, KeepsAnOrderUnderTheExponentialCost) {
  EXPECT_EQ(verdict(R"("method": "oracle", "than": "none", "metric": "bias_rmse",
                       "exponential_per_dps2": 100)"),
            "holds in these 2 scenarios");
}

TEST(Ledger, TellsTheMostFavourableReadingOfWhatDoesNotHold) {
  const auto wrong =
      claim_of(R"("of": "A", "method": "none", "than": "oracle", "metric": "bias_rmse")");
  const auto right = claim_of(
      R"("of": "A", "method": "oracle", "than": "none", "metric": "bias_rmse", "cells": ["quiet"])");
  const auto other = claim_of(R"("of": "B", "method": "none", "metric": "rate_std", "value": 1)");
  EXPECT_THAT(judged(wrong + "," + other + "," + right)[5],
              HasSubstr("bias_rmse of oracle below that of none in quiet: holds"));
  EXPECT_THAT(judged(wrong + "," + other)[5], HasSubstr("does not hold"));
  EXPECT_EQ(judged(right + "," + wrong)[5], "");
}

TEST(Ledger, SaysWhatItDoesNotJudge) {
  const auto row = judged(R"({"claim": "c", "not_judged": "no sensor of that kind"})" +
                          ("," + claim_of(R"("method": "kf", "than": "none", "metric": "nis")")));
  EXPECT_EQ(row[4], "not judged: no sensor of that kind");
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
  expect_one_line(ledger(R"("method": "kf", "value": 1, "allan_tau_s": [-1])"), "-1 s");
  // Ten seconds tell an Allan deviation at five.
  expect_one_line(ledger(R"("method": "none", "cells": ["loud"], "allan_tau_s": [1, 100])"),
                  "allan_tau_s: 100 s is out of range; allowed of cell loud: [0.05, 5] s");
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

/// As above, by the other search and the other loss.
TEST(Match, FindsItByTheCovarianceSearchToo) {
  const auto ended = match(std::string(R"("search": "covariance", "loss": "met", )") + target);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("1 of 1 within their tolerance"));
}

/// One evaluation, in the middle of the bounds, finds nothing that the start does not beat.
TEST(Match, GoesOnFromWhereAnEarlierSearchEnded) {
  const std::string from_middle(target);
  const auto at = from_middle.find("\"high\"");
  const auto from_start = from_middle.substr(0, at) + "\"start\": 0.19, " + from_middle.substr(at);
  const auto once = [](const std::string& keys) {
    const TestFolder folder;
    folder.write("study.json", study);
    folder.write("match.json", R"({"study": "study.json", "trials": 4, "evaluations": 1,
                                   "rounds": 1, )" +
                                   keys + "}");
    return run_program(folder, {"match", "match.json", "--format", "csv"}).out;
  };
  EXPECT_THAT(once(from_middle), HasSubstr("0 of 1 within their tolerance"));
  EXPECT_THAT(once(from_start), HasSubstr("1 of 1 within their tolerance"));
}

/// A parameter of one cell leaves the other alone: its 0.1 dps of noise stay.
TEST(Match, SetsAParameterInTheCellsThatItNames) {
  const auto ended = match(R"("free": [{"path": "scenario.random_error.measurement_noise_std_dps",
                                       "low": 0.001, "high": 1, "cells": ["quiet"]}],
      "targets": [
        {"cell": "quiet", "method": "none", "metric": "rate_std", "value": 0.2, "tolerance": 0.025},
        {"cell": "loud", "method": "none", "metric": "rate_std", "value": 0.11, "tolerance": 0.02}])");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("2 of 2 within their tolerance"));
}

/// Means of the noise beside what was published: in order for the oracle and none, not for two that
/// are the same filter.
TEST(Match, TellsWhetherTheMethodsStandInThePublishedOrder) {
  const auto ended = match(R"("free": [], "targets": [
        {"cell": "quiet", "method": "none", "metric": "bias_rmse", "value": 9, "tolerance": 1},
        {"cell": "quiet", "method": "oracle", "metric": "bias_rmse", "value": 8, "tolerance": 1},
        {"cell": "loud", "method": "kf", "metric": "bias_rmse", "value": 9, "tolerance": 1},
        {"cell": "loud", "method": "again", "metric": "bias_rmse", "value": 8, "tolerance": 1}])");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr(",0,4,bias_rmse quiet,2,"));
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
  expect_one_line(match(std::string(target) + R"(, "search": "covarance")"), "covariance");
  expect_one_line(match(std::string(target) + R"(, "loss": "mets")"), "met");
  expect_one_line(match(R"("free": [{"path": "trials", "low": 1, "high": 2, "cells": ["quit"]}],
                           "targets": [])"),
                  "quiet");
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
