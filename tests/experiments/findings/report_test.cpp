#include <cmath>
#include <regex>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/experiments/findings/report/replayed.hpp>
#include <gyrostat/experiments/findings/report/run_times.hpp>
#include <gyrostat/experiments/findings/report/sweep.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::report_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view study = R"({"title": "A <b>small</b> study", "seed": 7, "cells": [{
  "name": "small", "trials": 12, "parameters_from": "truth",
  "scenario": {"duration_s": 4, "rate_hz": 25,
    "random_error": {"phi": 0.5, "delta1_dps": 0.003, "delta2_dps": 0.001, "measurement_noise_std_dps": 0.02}},
  "filters": ["none", "kf", {"id": "risky", "filter": "sr_rsukf", "parameters": {"initial_phi_std": 0.316227766, "mu_phi": 0.05}}, "oracle"]}]})";

/// Every picture of a page, by its id.
std::map<std::string, json> pictures_of(const std::string& page) {
  std::map<std::string, json> pictures;
  const std::string open = "<script type=\"application/json\">";
  for (auto at = page.find(open); at != std::string::npos; at = page.find(open, at + 1)) {
    const auto from = at + open.size();
    auto picture = json::parse(page.substr(from, page.find("</script>", from) - from));
    pictures[picture["id"]] = picture;
  }
  return pictures;
}

/// A run of `text` in the folder and its page.
std::string page_of(const TestFolder& folder, std::string_view text,
                    std::vector<std::string> more = {}) {
  folder.write("study.json", text);
  const auto run = run_program(folder, {"run", "study.json", "--out", "run"});
  EXPECT_THAT(run.exit_code, testing::AnyOf(0, 3)) << run.err;
  more.insert(more.begin(), {"report", "run"});
  const auto report = run_program(folder, more);
  EXPECT_EQ(report.exit_code, 0) << report.err;
  return folder.read("run/report.html");
}

json mark_of(const json& picture, const std::string& kind, const std::string& name) {
  for (const auto& mark : picture["marks"])
    if (mark["kind"] == kind && mark["name"] == name) return mark;
  ADD_FAILURE() << "no " << kind << " " << name << " in " << picture["id"];
  return {};
}

TEST(Report, ItsNumbersAreThoseOfTheTables) {
  const TestFolder folder;
  const auto pictures = pictures_of(page_of(folder, study));
  for (const auto& table : json::parse(folder.read("run/tables.json"))) {
    if (table["title"] !=
        "small: bias estimation error (estimate - drift - random error), RMSE over time")
      continue;
    for (const auto& row : table["rows"]) {
      const auto box = mark_of(pictures.at("cell-0-boxes"), "boxes", row[0]);
      EXPECT_NEAR(box["x"][0].get<double>(), row[4].get<double>(), 1e-5 * row[4].get<double>());
      const auto line = mark_of(pictures.at("cell-0-convergence"), "line", row[0]);
      EXPECT_NEAR(line["y"].back().get<double>(), row[1].get<double>(),
                  1e-5 * row[1].get<double>());
      const auto ecdf = mark_of(pictures.at("cell-0-ecdf"), "line", row[0]);
      EXPECT_EQ(ecdf["x"].size(), 12U);
      EXPECT_NEAR(ecdf["x"].back().get<double>(), row[6].get<double>(),
                  1e-5 * row[6].get<double>());
      EXPECT_EQ(ecdf["y"].back(), 1.0);
    }
    return;
  }
  FAIL() << "no such table";
}

TEST(Report, TheSameFolderGivesTheSameBytesForAnyNumberOfThreads) {
  const TestFolder folder;
  const auto first = page_of(folder, study, {"--threads", "1"});
  ASSERT_EQ(
      run_program(folder, {"report", "run", "--out", "again.html", "--threads", "3"}).exit_code, 0);
  EXPECT_EQ(folder.read("again.html"), first);
}

TEST(Report, IsOneFileThatNamesNoHost) {
  const TestFolder folder;
  const auto page = page_of(folder, study);
  EXPECT_THAT(page, HasSubstr("A &lt;b&gt;small&lt;/b&gt; study"));
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(https?:)?//")));
}

TEST(Report, FailuresStandInItWithTheirAddresses) {
  const TestFolder folder;
  auto breaking = json::parse(study);  // phi is hardly observed: the risk update ceases to exist
  breaking["cells"][0]["scenario"] = {{"duration_s", 5},
                                      {"rate_hz", 100},
                                      {"random_error",
                                       {{"phi", 0.5},
                                        {"delta1_dps", 1e-5},
                                        {"delta2_dps", 0.0},
                                        {"measurement_noise_std_dps", 0.05}}}};
  const auto page = page_of(folder, breaking.dump());
  const auto failures = run_program(folder, {"status", "run", "--failures", "--format", "json"});
  const auto rows = json::parse(failures.out)[0]["rows"];
  ASSERT_FALSE(rows.empty());
  EXPECT_THAT(page, HasSubstr("gyrostat replay " + rows[0][0].get<std::string>()));
}

TEST(Report, OneTrialIsEnoughForAPage) {
  const TestFolder folder;
  folder.write("study.json", study);
  ASSERT_EQ(run_program(folder, {"run", "study.json", "--out", "run", "--trials", "1"}).exit_code,
            0);
  ASSERT_EQ(run_program(folder, {"report", "run"}).exit_code, 0);
  EXPECT_EQ(
      mark_of(pictures_of(folder.read("run/report.html")).at("cell-0-ecdf"), "line", "kf")["x"]
          .size(),
      1U);
}

TEST(Report, OfPiecesOfARecordingShowsInnovations) {
  const TestFolder folder;
  std::string csv = "t_s,gyro_dps\n";
  for (int i = 0; i < 2000; ++i)
    csv += std::to_string(0.02 * i) + "," + std::to_string(0.01 * std::sin(12.9898 * i * i)) + "\n";
  folder.write("rec.csv", csv);
  const auto pictures =
      pictures_of(page_of(folder, R"({"title": "pieces", "cells": [{"name": "pieces",
      "pieces": {"file": "rec.csv", "from_s": 10, "duration_s": 5}, "filters": ["none", "kf"]}]})"));
  EXPECT_EQ(pictures.at("cell-0-error")["title"], "Innovation over time");
  EXPECT_EQ(pictures.at("cell-0-boxes")["x"]["unit"], "nat");
}

TEST(Report, AThermalCellHasAPage) {
  const TestFolder folder;
  const auto pictures =
      pictures_of(page_of(folder, R"({"title": "ramp", "cells": [{"name": "ramp", "trials": 5,
      "scenario": {"duration_s": 300, "rate_hz": 2, "thermal_drift": {"a_dps_per_C": 0.002, "b_dps_s_per_C": 0.1, "c_dps": -0.05},
        "random_error": {"measurement_noise_std_dps": 0.02}, "temperature": {"profile": "ramp_and_cooling", "peak_C": 57},
        "compass": {"noise_std_deg": 0.05}},
      "calibration": {"fit": "moments"}, "filters": ["none", "thermal_kf", "oracle"]}]})"));
  const auto heading = mark_of(pictures.at("cell-0-heading"), "line", "thermal_kf");
  EXPECT_EQ(heading["x"].size(), 200U);
  EXPECT_EQ(heading["y"][0], 0.0);
}

TEST(Report, WithoutReplayHasNoPicturesOverTime) {
  const TestFolder folder;
  const auto pictures = pictures_of(page_of(folder, study, {"--replay", "0"}));
  EXPECT_FALSE(pictures.contains("cell-0-allan"));
  EXPECT_TRUE(pictures.contains("cell-0-boxes"));
}

TEST(Report, ComparesTrialsSimulatedAgainWithTheStores) {
  Replayed again{.trials = 3};
  again.methods.resize(2);
  again.methods[0].judged = {1.0, 2.0, no_value};
  again.methods[1].judged = {4.0, 5.0, 6.0};
  CellValues stored{.trials = {0, 2, 3}, .values = {{1.0, no_value, 9.0}, {4.0, 6.0, 9.0}}};
  EXPECT_EQ(compare(again, stored).compared, 4U);
  EXPECT_EQ(compare(again, stored).different, 0U);
  stored.values[1][1] = 6.5;
  stored.values[0][0] = no_value;
  EXPECT_EQ(compare(again, stored).different, 2U);
}

TEST(Report, WhatIsSimulatedAgainIsWhatIsStored) {
  const TestFolder folder;
  EXPECT_THAT(page_of(folder, study), Not(HasSubstr("of another build")));
}

TEST(Report, OverTwoParametersHasMapsAndTheWinnerIsTheLeastMean) {
  const TestFolder folder;
  auto grid = json::parse(study);
  grid["cells"][0]["grid"] = {{"scenario.random_error.phi", {0.1, 0.9}},
                              {"scenario.random_error.delta1_dps", {0.001, 0.01, 0.1}}};
  const auto page = page_of(folder, grid.dump());
  const auto pictures = pictures_of(page);
  std::size_t winners = 0;
  for (const auto& mark : pictures.at("sweep-0-winners")["marks"]) {
    winners += mark["x"].size();
    for (std::size_t i = 0; i < mark["x"].size(); ++i)
      for (const auto& other : pictures.at("sweep-0-heat")["marks"]) {
        if (other["name"] == "oracle") continue;
        const auto value = [&](const json& m) {
          for (std::size_t k = 0; k < m["x"].size(); ++k)
            if (m["x"][k] == mark["x"][i] && m["y"][k] == mark["y"][i])
              return std::stod(m["labels"][k].get<std::string>());
          return no_value;
        };
        const auto heat = mark_of(pictures.at("sweep-0-heat"), "cells", mark["name"]);
        EXPECT_LE(value(heat), value(other) * 1.01);  // labels have three digits
      }
  }
  EXPECT_EQ(winners, 6U);
  EXPECT_TRUE(pictures.contains("cell-0-boxes")) << "the first of a sweep is shown in full";
  EXPECT_FALSE(pictures.contains("cell-1-boxes"));
}

TEST(Report, ABadFolderOrCellIsOneLine) {
  const TestFolder folder;
  const auto nothing = run_program(folder, {"report", "nowhere"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("nowhere"));
  EXPECT_EQ(std::count(nothing.err.begin(), nothing.err.end(), '\n'), 1);
  page_of(folder, study);
  const auto cell = run_program(folder, {"report", "run", "--cell", "smal"});
  EXPECT_EQ(cell.exit_code, 2);
  EXPECT_THAT(cell.err, HasSubstr("small"));
  const auto itself = run_program(folder, {"report", "run", "--out", "run/store.db"});
  EXPECT_EQ(itself.exit_code, 2);
}

TEST(RunTimes, AreTheLastOfTheLogAndPassOverBrokenLines) {
  const TestFolder folder;
  folder.write("log.jsonl",
               "{\"cell\": \"a\", \"ns_per_step\": {\"kf\": 30.0}}\nnot json\n[1]\n"
               "{\"cell\": \"a\", \"ns_per_step\": {\"kf\": 20.5}}\n{\"cell\": \"b\"}\n{\"cell\": "
               "\"a\", \"ns_per_step\": {");
  const auto times = run_times(folder.path() / "log.jsonl");
  ASSERT_EQ(times.size(), 1U);
  EXPECT_EQ(times.at("a").at("kf"), 20.5);
  EXPECT_TRUE(run_times(folder.path() / "none").empty());
}

TEST(Sweep, IsReadFromTheNamesOfCells) {
  Study grid;
  for (const char* name :
       {"plain", "g[a=10,b=x,c=1]", "g[a=9,b=x,c=1]", "g[a=10,b=y,c=1]", "odd[3]"}) {
    grid.cells.emplace_back();
    grid.cells.back().name = name;
  }
  const auto sweeps = sweeps_of(grid);
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_THAT(sweeps[0].parameters, testing::ElementsAre("a", "b"));
  EXPECT_THAT(sweeps[0].levels(0), testing::ElementsAre("9", "10"));
  EXPECT_THAT(sweeps[0].cells, testing::ElementsAre(1, 2, 3));
}

TEST(Sweep, TheBaseOfOneAtATimeLiesOnEveryLine) {
  Study swept;
  for (const char* name : {"o[base]", "o[a=1]", "o[a=3]", "o[b=0.5]", "o[b=0.7]"}) {
    swept.cells.emplace_back();
    swept.cells.back().name = name;
  }
  swept.designs.push_back({.name = "o",
                           .kind = DesignKind::one_at_a_time,
                           .parameters = {{.name = "a"}, {.name = "b"}},
                           .base = {2.0, 0.6}});
  const auto sweeps = sweeps_of(swept);
  ASSERT_EQ(sweeps.size(), 2U);
  EXPECT_THAT(sweeps[0].levels(0), testing::ElementsAre("1", "2", "3"));
  EXPECT_THAT(sweeps[0].cells, testing::ElementsAre(1, 2, 0));
  EXPECT_THAT(sweeps[1].levels(0), testing::ElementsAre("0.5", "0.6", "0.7"));
}

}  // namespace
}  // namespace gyrostat::report_test
