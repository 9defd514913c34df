#include <gyrostat/experiments/run/failure_run.hpp>

#include <bit>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/experiments/run/failure_second_opinion.hpp>
#include <gyrostat/experiments/run/failure_signal.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::failure_run_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A gyro of white noise and a random walk, uncompensated: its heading at the end is linear in the
/// deviates. Steps of 1 s; the walk's k-th step moves all headings from there on.
constexpr int steps = 9;
constexpr double white = 1.0, walk = 0.3;

double white_variance() { return steps * white * white; }
double walk_variance() {
  // delta1 moves x from sample k on; x before the first sample is 0, and headings begin at the
  // second.
  double sum = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const double headings = k == 0 ? steps : steps - k + 1;
    sum += headings * headings * walk * walk;
  }
  return sum;
}

Study study_of(double probability, const std::string& more = "") {
  const double bound =
      normal_upper_quantile(probability) * std::sqrt(white_variance() + walk_variance());
  return parse_study(
      Json::parse(fmt::format(
          R"({{"seed": 5, "cells": [{{"name": "linear", "trials": 120, "parameters_from": "truth",
            "scenario": {{"duration_s": {}, "rate_hz": 1,
              "random_error": {{"phi": 0, "delta1_dps": {}, "delta2_dps": 0,
                              "measurement_noise_std_dps": {}}},
              "thermal_drift": {{"a_dps_per_C": 0, "b_dps_s_per_C": 0, "c_dps": 0}}}},
            "filters": ["none"],
            "failure": {{"metric": "heading_end", "above": {:.17g}{}}}}}]}})",
          steps + 1, walk, white, bound, more)),
      "linear.json");
}

/// Runs plain trials and search until `stop`, which is set once so many trials were told; the
/// search as the store then has it.
FailureSearch run(const Study& study, const fs::path& folder, const StudyRunOptions& options,
                  std::uint32_t most = UINT32_MAX) {
  std::atomic<bool> stop{false};
  Stopper stopper(stop);
  StudyRun plain(study, folder, options, stopper, {});
  const auto ran = plain.run();
  RunWatcher watcher;
  watcher.progress = [&](const CellProgress& now) {
    EXPECT_GT(now.trials_per_s, 0.0);
    EXPECT_NEAR(now.left_s * now.trials_per_s, now.trials - now.finished, 1e-6);
    stop = now.finished >= most;
  };
  run_failures(plain.study(), plain.store(), ran, folder, options, stop, watcher);
  return {*study.cells[0].failure, Store::open(folder / failure_folder), 0};
}

std::vector<std::uint64_t> bits_of(const fs::path& folder) {
  std::vector<std::uint64_t> bits;
  Store::open(folder / failure_folder)
      .for_each_trial(0, 1000000, [&](const Store::TrialView& trial) {
        bits.push_back(trial.trial);
        for (const double v : trial.outcomes) bits.push_back(std::bit_cast<std::uint64_t>(v));
      });
  return bits;
}

RareProbability told(const FailureSearch& search) {
  std::vector<double> runs;
  for (const auto& run : search.runs()) runs.push_back(run.probability());
  return rare_probability(runs);
}

TEST(FailureRun, OfALinearGaussianCellIsTheExactProbability) {
  const TestFolder folder;
  const auto study = study_of(1e-6);
  const auto search = run(study, folder.path(), {});
  ASSERT_TRUE(search.reached());
  EXPECT_LE(search.trials(), 20000U);
  // The variation at 1e-6 is 0.25; four times that, one false failure in 16,000 sets of seeds.
  EXPECT_NEAR(std::log(told(search).probability / 1e-6), 0.0, 1.0);

  const Store store = Store::open(folder.path() / failure_folder);
  const auto prepared = prepare_cell(study.cells[0], study.seed, 1);
  const auto& rule = *study.cells[0].failure;
  const auto seed = failure_seed(study);
  const auto means = failing_means(prepared, rule, search, store, 0, seed);
  ASSERT_TRUE(means);
  const auto signal = failure_signal(prepared, rule, *means, seed);
  ASSERT_TRUE(signal);
  // A linear failure's design point is as far as its reliability index, and each input's share
  // that in the variance. The means of eight runs' failing trials, of some twenty that are
  // independent each, are known to a tenth.
  EXPECT_NEAR(signal->distance, normal_upper_quantile(1e-6), 0.5);
  EXPECT_NEAR(signal->metric, study.cells[0].failure->threshold, 0.1);
  const double whole = white_variance() + walk_variance();
  EXPECT_NEAR(signal->drivers.at("white_noise"), white_variance() / whole, 0.1);
  EXPECT_NEAR(signal->drivers.at("random_error"), walk_variance() / whole, 0.1);
  EXPECT_EQ(signal->same_side, 1.0);

  const auto second = second_opinion(prepared, rule, *means, search.numbers(), seed);
  ASSERT_TRUE(second && second->probability);
  // Along the very direction, 4,000 trials tell a half-space of 1e-6 to a twentieth; this one is
  // known to a few degrees. Four of its own standard errors: one false failure in 16,000 sets of
  // seeds, were they known.
  EXPECT_GT(second->closeness, 0.8);
  EXPECT_LT(second->probability->variation, 0.15);
  EXPECT_NEAR(std::log(second->probability->probability / 1e-6), 0.0,
              5.4 * second->probability->variation);
  EXPECT_FALSE(disagree(told(search), *second->probability, 7.0));
}

/// A metric that is bad to both sides: half of the trials are moved against the direction.
TEST(FailureRun, ASecondOpinionHasBothSides) {
  const TestFolder folder;
  auto text = Json::parse(study_of(0.5e-5).source);
  text["cells"][0]["failure"]["metric"] = "heading_worst";
  text["cells"][0]["scenario"]["random_error"]["measurement_noise_std_dps"] = 0.001;
  text["cells"][0]["scenario"]["random_error"]["delta1_dps"] = 1.0;
  const auto study = parse_study(text, "both.json");
  const auto search = run(study, folder.path(), {});
  ASSERT_TRUE(search.reached());
  const Store store = Store::open(folder.path() / failure_folder);
  const auto prepared = prepare_cell(study.cells[0], study.seed, 1);
  const auto& rule = *study.cells[0].failure;
  const auto seed = failure_seed(study);
  const auto means = failing_means(prepared, rule, search, store, 0, seed);
  ASSERT_TRUE(means);
  EXPECT_LT(means->same_side, 0.9);
  const auto second = second_opinion(prepared, rule, *means, search.numbers(), seed);
  ASSERT_TRUE(second && second->probability);
  EXPECT_FALSE(disagree(told(search), *second->probability, 7.0));
}

TEST(FailureRun, AnInterruptedSearchGoesOnToTheSameBytesOnAnyThreadsAndLanes) {
  const TestFolder one, other;
  const auto study = study_of(1e-3, R"(, "runs": 3, "samples": 100)");
  const auto whole = run(study, one.path(), {.threads = 1, .lanes = 1});
  ASSERT_TRUE(whole.reached());
  const auto half = run(study, other.path(), {.threads = 4, .lanes = 4}, 400);
  EXPECT_FALSE(half.asked().empty());
  EXPECT_LT(half.trials(), whole.trials());
  run(study, other.path(), {.threads = 3, .lanes = 2});
  EXPECT_EQ(bits_of(one.path()), bits_of(other.path()));
}

/// 500 of 1,000 fail: nothing is searched for.
TEST(FailureRun, SearchesForNothingThatPlainTrialsTell) {
  const TestFolder folder;
  auto study = study_of(0.5);
  set_trials(study, 1000);
  const auto search = run(study, folder.path(), {});
  EXPECT_EQ(search.trials(), 0U);
}

TEST(FailureRun, IsToldByTheProgramAndReplayed) {
  TestFolder folder;
  folder.write("s.json", study_of(1e-4).source);
  const auto ran = run_program(folder, {"run", "s.json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("linear: how likely is heading_end above"));
  EXPECT_THAT(run_program(folder, {"status", "runs/s"}).out, HasSubstr("searches for failures"));
  const auto how = run_program(folder, {"failure", "runs/s", "--how"});
  EXPECT_EQ(how.exit_code, 0) << how.err;
  EXPECT_THAT(how.out, HasSubstr("linear: how none fails"));
  EXPECT_THAT(how.out, HasSubstr("agrees with subset simulation"));
  EXPECT_THAT(how.out, HasSubstr("importance sampling along it: "));
  const auto replayed = run_program(folder, {"replay", "s:linear:failure:none"});
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_THAT(replayed.out, HasSubstr("the most likely failing signal"));
  const auto ranked = run_program(folder, {"rank", "runs/s", "--metric", "failure"});
  EXPECT_EQ(ranked.exit_code, 0) << ranked.err;
  EXPECT_THAT(ranked.out, HasSubstr("linear: ranking by how likely is heading_end above"));
  EXPECT_EQ(
      run_program(folder, {"rank", "runs/s", "--metric", "failure", "--figures", "f"}).exit_code,
      2);
  ASSERT_EQ(run_program(folder, {"report", "runs/s"}).exit_code, 0);
  const auto page = folder.read("runs/s/report.html");
  EXPECT_THAT(page, HasSubstr("id=\"cell-0-failure-levels\""));
  EXPECT_THAT(page, HasSubstr("id=\"cell-0-failing-signal\""));
  // A changed threshold is another search, and the old one is kept.
  folder.write("s.json", study_of(1e-3).source);
  const auto again = run_program(folder, {"run", "s.json"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("the search before is kept as"));
}

TEST(FailureRun, OutOfLevelsItIsToldWhatItIsRarerThan) {
  const TestFolder folder;
  folder.write("s.json", R"({"seed": 1, "cells": [{"name": "c", "trials": 50,
    "parameters_from": "truth", "scenario": {"duration_s": 2, "rate_hz": 50}, "filters": ["none"],
    "failure": {"metric": "heading_end", "above": 1, "levels": 2, "samples": 100, "runs": 4}}]})");
  const auto ran = run_program(folder, {"run", "s.json", "--format", "md"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("subset simulation, rarer than"));
  EXPECT_THAT(ran.out, HasSubstr("none: heading_end above 1 deg is rarer than 0.01"));
}

TEST(FailureRun, AFailureThatCannotBeIsAMistakeWithItsPlace) {
  const auto mistake = [](const std::string& failure) {
    const auto text = R"({"cells": [{"name": "c", "trials": 5, "parameters_from": "truth",
        "scenario": {"duration_s": 2, "rate_hz": 10}, "filters": ["none", "kf"],
        "failure": )" +
                      failure + "}]}";
    try {
      parse_study(Json::parse(text), "s.json");
    } catch (const InputError& found) {
      return std::string(found.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(mistake(R"({"metric": "heading_worst", "above": 5, "methods": ["kf"]})"), "none");
  EXPECT_THAT(mistake(R"({"metric": "heading_worts", "above": 5})"), HasSubstr("heading_worst"));
  EXPECT_THAT(mistake(R"({"above": 5})"), HasSubstr("\"metric\" is missing"));
  EXPECT_THAT(mistake(R"({"metric": "heading_worst"})"), HasSubstr("\"above\" or \"below\""));
  EXPECT_THAT(mistake(R"({"metric": "heading_worst", "above": 1, "below": 2})"),
              HasSubstr("\"above\" or \"below\""));
  EXPECT_THAT(mistake(R"({"metric": "heading_worst", "above": "5"})"),
              HasSubstr("s.json: cells[0].failure.above: \"5\" is not a number"));
  EXPECT_THAT(mistake(R"({"metric": "heading_worst", "above": 5, "methods": ["kff"]})"),
              HasSubstr("kf"));
  EXPECT_THAT(mistake(R"({"metric": "heading_worst", "above": 5, "samples": 10})"),
              HasSubstr("out of range"));
  EXPECT_THAT(mistake(R"({"metric": "heading_worst", "above": 5, "run": 8})"), HasSubstr("runs"));
}

}  // namespace
}  // namespace gyrostat::failure_run_test
