#include <gyrostat/experiments/findings/ranking.hpp>

#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/findings/ranking_words.hpp>
#include <gyrostat/experiments/run/trial.hpp>
#include <gyrostat/results/render/interval.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::ranking_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

const std::size_t metric_count = metric_types().size();
const std::size_t columns = metric_count + Outcome::beside_metrics;

Cell cell_of(const std::vector<std::string>& filters) {
  Cell cell;
  cell.name = "ramp";
  for (const auto& filter : filters) {
    Method method;
    method.id = filter;
    method.filter = filter.substr(0, filter.find('#'));
    cell.methods.push_back(method);
  }
  return cell;
}

/// Trials of which each gives every method its bias error.
TrialSource source_of(const std::vector<std::vector<double>>& errors,
                      const char* metric = "bias_rmse") {
  return [errors, at = metric_named(metric, "test")](const auto& visit) {
    for (const auto& trial : errors) {
      std::vector<double> outcomes(trial.size() * columns);
      for (std::size_t m = 0; m < trial.size(); ++m) {
        outcomes[m * columns + at] = trial[m];
        outcomes[m * columns + metric_count] = 1.0;
      }
      visit(true, outcomes);
    }
  };
}

/// kf is best; stf and thermal_kf differ by far less than their spread; none is worst.
std::vector<std::vector<double>> four_methods(int trials) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> errors;
  for (int t = 0; t < trials; ++t)
    errors.push_back({9.0 + normal(random), 2.001 + 0.1 * normal(random),
                      1.0 + 0.1 * normal(random), 2.0 + 0.1 * normal(random)});
  return errors;
}

const std::vector<std::string> names = {"none", "stf", "kf", "thermal_kf"};

TEST(Ranking, OrdersByTheMeanAndGroupsWhatIsNotSeparable) {
  const auto errors = four_methods(300);
  const auto ranking = rank_cell(cell_of(names), source_of(errors));
  ASSERT_EQ(ranking.methods.size(), 4U);
  EXPECT_EQ(ranking.methods.front().method, "kf");
  EXPECT_EQ(ranking.methods.back().method, "none");
  EXPECT_THAT(ranking.not_separable, ElementsAre(ElementsAre(1, 2)));
  EXPECT_LT(ranking.friedman_p, 1e-10);
  EXPECT_EQ(ranking.pairs.size(), 6U);
  for (const auto& pair : ranking.pairs) EXPECT_GE(pair.difference.mean, 0.0);
  std::vector<double> kf;
  for (const auto& trial : errors) kf.push_back(trial[2]);
  const auto summary = summarise(kf);
  EXPECT_EQ(ranking.methods.front().mean, summary.mean);
  EXPECT_EQ(ranking.methods.front().half_width, summary.half_width_95);
  EXPECT_EQ(ranking.methods.front().worst, summary.worst);
  EXPECT_GT(ranking.methods.front().cvar95, summary.percentile_95);
}

TEST(Ranking, AHundredMethodsThatAreAlikeAreOneGroupAtOnce) {
  std::vector<std::string> many;
  std::vector<std::vector<double>> errors(4);
  for (int m = 0; m < 100; ++m) {
    many.push_back(fmt::format("kf#{}", m));
    for (int trial = 0; trial < 4; ++trial)
      errors[static_cast<std::size_t>(trial)].push_back(trial == m % 4 ? 2.0 : 1.0);
  }
  const auto ranking = rank_cell(cell_of(many), source_of(errors));
  ASSERT_EQ(ranking.not_separable.size(), 1U);
  EXPECT_EQ(ranking.not_separable.front().size(), 100U);
}

TEST(Ranking, GroupsThatNobodyCouldReadAreNotAllSought) {
  // Twenty pairs that are told apart, whatever the pair: 2^20 groups.
  std::vector<std::string> many;
  std::vector<std::vector<double>> errors(60);
  for (int m = 0; m < 40; ++m) {
    many.push_back(fmt::format("kf#{}", m));
    for (std::size_t trial = 0; trial < errors.size(); ++trial)
      errors[trial].push_back(
          100.0 + 10.0 * std::cos(1.7 * (m / 2 + 1) * (static_cast<double>(trial) + m / 2)) +
          (m % 2 == 0 ? 0.0 : 1.0 + 0.1 * std::sin(static_cast<double>(trial))));
  }
  const auto ranking = rank_cell(cell_of(many), source_of(errors));
  EXPECT_EQ(ranking.not_separable.size(), CellRanking::most_groups);
  for (const auto& group : ranking.not_separable) EXPECT_THAT(group, SizeIs(20));
}

TEST(Ranking, SaysItInPlainSentences) {
  const auto sentences = rank_cell(cell_of(names), source_of(four_methods(300))).sentences;
  EXPECT_THAT(sentences.front(),
              HasSubstr("kf has the smallest bias estimation error, RMSE, on average over 300 "
                        "trials: 1.0"));
  EXPECT_THAT(sentences.front(), HasSubstr("it beats every other filter"));
  EXPECT_THAT(sentences, Contains(HasSubstr("kf beats ")));
  EXPECT_THAT(sentences, Contains(testing::AllOf(HasSubstr("not separable ("),
                                                 HasSubstr(" more trials needed"))));
  EXPECT_THAT(sentences, Contains(testing::StartsWith("kf beats none in bias_rmse by 8.")));
}

TEST(Ranking, RanksErrorsWithASignByTheirSize) {
  const auto ranking = rank_cell(
      cell_of({"kf", "stf"}), source_of({{-5, 1}, {5, -1}, {-4, 1}}, "heading_end"), "heading_end");
  EXPECT_EQ(ranking.methods.front().method, "stf");
  EXPECT_EQ(ranking.methods.front().mean, 1.0);
  EXPECT_EQ(ranking.methods.front().mean_rank, 1.0);
}

TEST(Ranking, AMethodWithoutAValueRanksLastInThatTrial) {
  const auto ranking =
      rank_cell(cell_of({"kf", "stf"}), source_of({{no_value, 1}, {0.5, 1}, {0.5, 1}, {0.5, 1}}));
  EXPECT_EQ(ranking.methods.front().method, "kf");
  EXPECT_EQ(ranking.methods.front().missing, 1U);
  EXPECT_EQ(ranking.methods.front().mean_rank, 1.25);
  EXPECT_THAT(ranking.sentences, Contains(HasSubstr("kf has no value in 1 trial,")));
}

TEST(Ranking, WhatIsEqualIsSaidToBeEqual) {
  const auto ranking = rank_cell(cell_of({"kf", "stf"}), source_of({{1, 1}, {2, 2}, {3, 3}}));
  EXPECT_THAT(ranking.sentences, Contains(HasSubstr("equal to rounding")));
  EXPECT_THAT(ranking.not_separable, ElementsAre(ElementsAre(0, 1)));
}

TEST(Ranking, RoundingErrorsHaveNoWinner) {
  const auto ranking = rank_cell(
      cell_of({"kf", "stf"}), source_of({{1e-17, 2e-17}, {1.1e-17, 2.1e-17}, {0.9e-17, 2.2e-17}}));
  EXPECT_THAT(ranking.sentences, Contains(HasSubstr("every filter is exact to rounding")));
  for (const auto& sentence : ranking.sentences) {
    EXPECT_THAT(sentence, Not(HasSubstr("beats")));
    EXPECT_THAT(sentence, Not(HasSubstr("smallest")));
  }
}

TEST(Ranking, IsAskedOfErrorsAlone) {
  const auto cell = cell_of({"kf", "stf"});
  EXPECT_THROW(rank_cell(cell, source_of({{1, 2}}), "nis"), InputError);
  EXPECT_THROW(rank_cell(cell, source_of({{1, 2}}), "bias"), InputError);
}

TEST(Ranking, RoundsAValueAsItsIntervalAllows) {
  EXPECT_EQ(with_half_width(0.3104, 0.0421), "0.310 ± 0.042");
  EXPECT_EQ(with_half_width(12345.6, 234.5), "12346 ± 234");
  EXPECT_EQ(with_half_width(1.5, 0.0), "1.5");
  EXPECT_EQ(with_interval(0.3104, 0.27, 0.3525), "0.310 ± 0.042");
  EXPECT_EQ(with_interval(0.3104, 0.11, 0.834), "0.31 (0.11 to 0.83)");
  EXPECT_EQ(with_interval(0.08696, 0.07404, 0.1047), "0.087 (0.074 to 0.105)");
  EXPECT_EQ(with_interval(1234.0, 1100.0, 2000.0), "1234 (1100 to 2000)");
  EXPECT_EQ(with_interval(-1e-12, -1e-12, -1e-12), "-1e-12");
}

TEST(Ranking, TheVerbTellsAboutAFinishedRun) {
  const TestFolder folder;
  folder.write("s.json", R"({"cells": [{"name": "c", "trials": 60, "parameters_from": "truth",
    "scenario": {"duration_s": 10, "rate_hz": 20}, "filters": ["none", "kf", "oracle"]}]})");
  const auto ran = run_program(folder, {"run", "s.json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("c: ranking by bias_rmse"));
  const auto ranked = run_program(folder, {"rank", "runs/s", "--metric", "heading_worst"});
  EXPECT_EQ(ranked.exit_code, 0) << ranked.err;
  EXPECT_THAT(ranked.out, HasSubstr("c: ranking by heading_worst"));
  EXPECT_THAT(ranked.out, HasSubstr("Nemenyi"));
  EXPECT_EQ(run_program(folder, {"rank", "runs/s", "--metric", "nis"}).exit_code, 2);
  EXPECT_EQ(run_program(folder, {"rank", "runs/s", "--cell", "d"}).exit_code, 2);
}

}  // namespace
}  // namespace gyrostat::ranking_test
