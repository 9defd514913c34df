// Filters and effects of somebody else, as the program runs them: what is wrong with one is told in
// one line, or costs the trials that it is in and no other.

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::plugins_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A sanitizer would catch the crashes that are meant, and make exit codes of them.
[[maybe_unused]] const int as_without_sanitizer = setenv("ASAN_OPTIONS", "handle_segv=0", 0);

/// Built beside the tests.
std::string library(const std::string& name) { return places::plugins() + "/" + name + ".so"; }

std::vector<std::string> with(std::vector<std::string> words, const std::string& name) {
  words.insert(words.end(), {"--plugin", library(name)});
  return words;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// 24 trials of 8 s with these filters beside two of ours.
std::string study_with(const std::string& filters, const std::string& effects = "") {
  return R"({"seed": 3, "cells": [{"name": "c", "trials": 24, "parameters_from": "truth",
    "scenario": {"duration_s": 8, "rate_hz": 50, "effects": [)" +
         effects + R"(]}, "filters": ["none", "kf", )" + filters + "]}]}";
}

/// Trial and method of each row of the export, with the rest of the row.
std::map<std::pair<int, std::string>, std::string> rows_of(const std::string& csv) {
  std::map<std::pair<int, std::string>, std::string> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell, trial, method, rest;
    std::getline(cells, cell, ',');
    std::getline(cells, trial, ',');
    std::getline(cells, method, ',');
    std::getline(cells, rest);
    rows[{std::stoi(trial), method}] = rest;
  }
  return rows;
}

/// A row of a trial that failed, which has no numbers.
bool is_missing(const std::string& row) { return row.starts_with(","); }

TEST(Plugins, WhatCannotBeUsedIsToldInOneLine) {
  const TestFolder folder;
  const std::map<std::string, std::vector<std::string>> expected = {
      {"other_abi", {"is built for version 7 of gyrostat_plugin.h; this gyrostat has version 1"}},
      {"symbol_missing", {"has no function gyrostat_describe"}},
      {"step_missing", {"unusable lacks create, step or destroy"}},
      {"name_taken", {"'kf': there is another filter of this name"}},
      {"name_unfit", {"filters[0].name", "\"my filter\" is no name"}},
      {"default_out_of_range",
       {"filters[0].parameters[0].default", "0.5 is out of range; allowed: [1, inf)"}},
      {"crashes", {"ended by signal 11 (Segmentation fault) before it has described itself"}}};
  for (const auto& [name, words] : expected)
    for (const auto& command : {with({"list"}, name), {"check-plugin", library(name)}}) {
      const auto ended = run_program(folder, command);
      EXPECT_EQ(ended.exit_code, 2) << name;
      EXPECT_EQ(ended.out, "") << name;
      EXPECT_EQ(lines_of(ended.err), 1U) << ended.err;
      EXPECT_THAT(ended.err, HasSubstr(library(name)));
      for (const auto& word : words) EXPECT_THAT(ended.err, HasSubstr(word));
    }
  EXPECT_THAT(run_program(folder, {"list", "--plugin", "no.so"}).err,
              HasSubstr("no.so: there is no such file"));
  folder.write("text.so", "not a library");
  EXPECT_THAT(run_program(folder, {"list", "--plugin", "text.so"}).err,
              HasSubstr("cannot be loaded"));
  const auto twice = run_program(folder, with(with({"list"}, "misbehaving"), "misbehaving"));
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("'sound': there is another filter of this name"));
}

TEST(Plugins, AProcessThatDescribesItselfBadlyIsToldInOneLine) {
  const TestFolder folder;
  const std::map<std::string, std::string> expected = {
      {"no_such_program", "ended with exit code 127: No such file or directory"},
      {"sh -c 'echo oops >&2; exit 3'", "ended with exit code 3: oops"},
      {"echo hello", "its first line is no JSON object: \"hello\""},
      {"echo '{\"name\": \"mine\"}'", "speaks protocol unknown; this gyrostat speaks 1"},
      {"echo '{\"protocol\": 2, \"name\": \"mine\"}'", "speaks protocol 2; this gyrostat speaks 1"},
      {"echo '{\"protocol\": 1, \"name\": \"mine\", \"tilte\": \"x\"}'",
       "unknown key 'tilte'; did you mean 'title'?"},
      {"echo '{\"protocol\": 1}'", "\"name\" is missing"},
      {"echo 'unclosed", "a quote ' is not closed"},
      {"sleep 100", "gave no answer for 4 s"}};
  for (const auto& [command, words] : expected) {
    const auto ended = run_program(
        folder, {"list", "filters", "--filter-command", command, "--plugin-limit", "4"});
    EXPECT_EQ(ended.exit_code, 2) << command;
    EXPECT_EQ(lines_of(ended.err), 1U) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr(words));
  }
}

TEST(Plugins, StandBesideOurs) {
  const TestFolder folder;
  const auto all =
      nlohmann::json::parse(run_program(folder, with({"list", "--json"}, "misbehaving")).out);
  const auto is_sound = [](const auto& entry) { return entry["id"] == "sound"; };
  const auto listed = std::find_if(all["filters"].begin(), all["filters"].end(), is_sound);
  ASSERT_NE(listed, all["filters"].end());
  EXPECT_EQ((*listed)["parameters"][0]["range"], "[1, inf)");
  const auto schema = run_program(folder, with({"schema"}, "misbehaving")).out;
  EXPECT_THAT(schema, AllOf(HasSubstr("parameters_of_sound"), HasSubstr("\"lasting\"")));

  folder.write("s.json",
               study_with(R"({"filter": "sound", "parameters": {"time_constant": 0.5}})"));
  const auto unsound = run_program(folder, with({"validate", "s.json"}, "misbehaving"));
  EXPECT_EQ(unsound.exit_code, 2);
  EXPECT_THAT(unsound.err, HasSubstr("0.5 samples is out of range; allowed: [1, inf) samples"));
  folder.write("s.json", study_with(R"("sound")"));
  EXPECT_EQ(run_program(folder, with({"validate", "s.json"}, "misbehaving")).exit_code, 0);
  EXPECT_THAT(run_program(folder, {"validate", "s.json"}).err, HasSubstr("unknown filter 'sound'"));
}

/// The filter and the same one of ours agree to the bit, whatever is between them.
TEST(Plugins, WhatComesBackIsWhatTheFilterSaid) {
  const TestFolder folder;
  folder.write("s.json", study_with(R"("sound", {"id": "again", "filter": "sound"})"));
  const auto command = with({"run", "s.json", "--threads", "2"}, "misbehaving");
  ASSERT_EQ(run_program(folder, command).exit_code, 0);
  const auto rows = rows_of(run_program(folder, {"export", "runs/s"}).out);
  EXPECT_EQ(rows.size(), 24U * 4U);
  for (int trial = 0; trial < 24; ++trial)
    EXPECT_EQ(rows.at({trial, "sound"}), rows.at({trial, "again"})) << trial;
}

/// In `name`, and in no other, the trials that are struck fail; and nobody else's numbers move.
void expect_own_trials_only(const std::string& name, const std::string& reason) {
  const TestFolder folder, peaceful;
  folder.write("s.json", study_with("\"sound\", \"" + name + "\""));
  peaceful.write("s.json", study_with(R"("sound")"));
  ASSERT_EQ(run_program(peaceful, with({"run", "s.json"}, "misbehaving")).exit_code, 0);
  const auto undisturbed = rows_of(run_program(peaceful, {"export", "runs/s"}).out);

  std::string first;
  for (const std::string threads : {"1", "2"}) {
    std::filesystem::remove_all(folder.path() / "runs");
    const auto command = with({"run", "s.json", "--threads", threads}, "misbehaving");
    const auto ended = run_program(folder, command);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto csv = run_program(folder, {"export", "runs/s"}).out;
    if (threads == "1") first = csv;
    EXPECT_EQ(csv, first) << "with two threads";
  }
  auto rows = rows_of(first);
  std::size_t failed = 0;
  for (int trial = 0; trial < 24; ++trial) {
    for (const auto* other : {"none", "kf", "sound"})
      EXPECT_EQ(rows.at({trial, other}), undisturbed.at({trial, other})) << trial << other;
    failed += is_missing(rows.at({trial, name}));
  }
  EXPECT_GT(failed, 0U);
  EXPECT_LT(failed, 24U);
  const auto failures =
      run_program(folder,
                  with({"status", "runs/s", "--failures", "--format", "csv"}, "misbehaving"))
          .out;
  std::size_t told = 0;
  for (std::size_t at = 0; (at = failures.find(reason, at)) != std::string::npos; ++at) ++told;
  EXPECT_EQ(told, failed) << failures;
}

TEST(Plugins, ACrashCostsItsOwnTrials) {
  expect_own_trials_only("crashing",
                         "crashing in samples 0 to 399 ended by signal 11 (Segmentation fault)");
}

TEST(Plugins, AnEstimateThatIsNoNumberCostsItsOwnTrials) {
  expect_own_trials_only("not_finite", "not_finite at sample 299 gave an estimate of nan dps");
}

TEST(Plugins, AHangCostsItsOwnTrials) {
  const TestFolder folder;
  auto study = study_with(R"("hanging")");
  study.replace(study.find("24"), 2, "2");  // of which one is struck
  folder.write("s.json", study);
  const auto ended = run_program(
      folder, with({"run", "s.json", "--plugin-limit", "3", "--lanes", "1"}, "hanging"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto failures =
      run_program(folder, with({"status", "runs/s", "--failures", "--format", "csv"}, "hanging"))
          .out;
  EXPECT_THAT(failures, HasSubstr("hanging in samples 0 to 399 gave no answer for 3 s"));
  const auto rows = rows_of(run_program(folder, {"export", "runs/s"}).out);
  EXPECT_EQ(rows.size(), 6U);
  EXPECT_NE(is_missing(rows.at({0, "hanging"})), is_missing(rows.at({1, "hanging"})));
  for (const int trial : {0, 1}) EXPECT_FALSE(is_missing(rows.at({trial, "kf"})));
}

/// A plug-in that fails in the calibration: every trial of its cell has that as its outcome, those
/// of the cell behind it have the bits that they have alone.
TEST(Plugins, AFailedCalibrationCostsItsCell) {
  const TestFolder folder, alone;
  // Of a bias that is above zero by 20 standard deviations, so that `ending` ends in any signal.
  const std::string broken =
      R"({"name": "broken", "trials": 5, "filters": ["none", "kf"], "scenario":
      {"duration_s": 8, "rate_hz": 50, "thermal_drift": {"c_dps": 1}, "effects": [{"effect": "ending"}]}})";
  const std::string sound = R"({"name": "c", "trials": 5, "filters": ["none", "kf"], "scenario":
      {"duration_s": 8, "rate_hz": 50}})";
  folder.write("s.json", R"({"cells": [)" + broken + ", " + sound + "]}");
  alone.write("s.json", R"({"cells": [)" + sound + "]}");
  ASSERT_EQ(run_program(alone, {"run", "s.json"}).exit_code, 0);
  const auto ended = run_program(folder, with({"run", "s.json"}, "misbehaving"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("broken: calibration or tuning: ending"));
  EXPECT_THAT(ended.err, HasSubstr("5 trials failed"));

  const auto csv = run_program(folder, {"export", "runs/s"}).out;
  const auto theirs = run_program(alone, {"export", "runs/s"}).out;
  const auto from_c = [](const std::string& text) { return text.substr(text.find("\nc,")); };
  EXPECT_EQ(from_c(csv), from_c(theirs));
  for (const auto& [at, row] : rows_of(csv.substr(0, csv.find("\nc,"))))
    EXPECT_TRUE(is_missing(row)) << at.first;
  const auto failures =
      run_program(folder,
                  with({"status", "runs/s", "--failures", "--format", "csv"}, "misbehaving"))
          .out;
  EXPECT_THAT(failures, HasSubstr("ending"));
  EXPECT_EQ(run_program(folder, with({"report", "runs/s"}, "misbehaving")).exit_code, 0);
  const auto over = run_program(
      folder, with({"run", "s.json", "--out", "strict", "--failure-budget", "0.1"}, "misbehaving"));
  EXPECT_EQ(over.exit_code, 3) << over.err;
}

TEST(Plugins, WhatALibraryPrintsDoesNoHarm) {
  const TestFolder folder;
  folder.write("s.json", study_with(R"("sound", "chatting")"));
  ASSERT_EQ(run_program(folder, with({"run", "s.json"}, "misbehaving")).exit_code, 0);
  const auto rows = rows_of(run_program(folder, {"export", "runs/s"}).out);
  for (int trial = 0; trial < 24; ++trial)
    EXPECT_EQ(rows.at({trial, "sound"}), rows.at({trial, "chatting"})) << trial;
}

TEST(Plugins, AnEffectThatEndsItsProcessCostsItsOwnTrials) {
  const TestFolder folder;
  folder.write("s.json", study_with(R"("sound")", R"({"effect": "ending"})"));
  EXPECT_EQ(run_program(folder, with({"run", "s.json"}, "misbehaving")).exit_code, 0);
  const auto failures =
      run_program(folder,
                  with({"status", "runs/s", "--failures", "--format", "csv"}, "misbehaving"))
          .out;
  EXPECT_THAT(failures, HasSubstr("ending ended with exit code 7"));
  const auto rows = rows_of(run_program(folder, {"export", "runs/s"}).out);
  std::size_t failed = 0;
  for (int trial = 0; trial < 24; ++trial) failed += is_missing(rows.at({trial, "kf"}));
  EXPECT_GT(failed, 0U);
  EXPECT_LT(failed, 24U);
}

TEST(Plugins, AProcessThatFailsCostsItsOwnTrials) {
  const TestFolder folder;
  // Its first line, then an answer to nothing: a shell is a filter in one line.
  folder.write("s.json", study_with(R"("garbage")"));
  const std::string garbage =
      "sh -c 'echo \"{\\\"protocol\\\": 1, \\\"name\\\": \\\"garbage\\\"}\"; head -c 16 "
      ">/dev/null; "
      "exec yes estimate'";
  const auto ended =
      run_program(folder, {"run", "s.json", "--filter-command", garbage, "--threads", "2"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto failures = run_program(folder, {"status", "runs/s", "--failures", "--format", "csv",
                                             "--filter-command", garbage})
                            .out;
  EXPECT_THAT(failures, HasSubstr("garbage in samples 0 to 399 answered garbage"));
}

TEST(Plugins, CheckPluginTellsWhichLawIsBroken) {
  const TestFolder folder;
  const auto ended =
      run_program(folder, {"check-plugin", library("misbehaving"), "--format", "csv"});
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  std::map<std::string, std::set<std::string>> broken;
  std::istringstream lines(ended.out);
  std::map<std::string, int> laws;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string plugin, law;
    std::getline(cells, plugin, ',');
    std::getline(cells, law, ',');
    if (line.find("BROKEN") != std::string::npos) broken[plugin].insert(law);
    ++laws[plugin];
  }
  using Laws = std::set<std::string>;
  EXPECT_EQ(laws.at("sound"), 7) << ended.out;
  EXPECT_EQ(broken.count("sound"), 0U) << ended.out;
  EXPECT_EQ(broken.count("chatting"), 0U) << ended.out;
  EXPECT_EQ(broken["alone"], Laws{"no instance reaches another"});
  EXPECT_EQ(broken["remembering"],
            (Laws{"no trial reaches the next", "no instance reaches another"}));
  EXPECT_EQ(broken["foreseeing"], (Laws{"blocks of any size", "no instance reaches another"}));
  EXPECT_TRUE(broken["whimsical"].contains("the same bits again"));
  EXPECT_TRUE(broken["lasting"].contains("absent it changes nothing"));
  EXPECT_TRUE(broken["lasting"].contains("no trial reaches the next"));
  const auto sound_one = run_program(folder, {"check-plugin"});
  EXPECT_EQ(sound_one.exit_code, 2);
}

TEST(Plugins, AStoreKnowsWithWhichOneItWasMade) {
  const TestFolder folder;
  folder.write("s.json", study_with(R"("mine")"));
  std::filesystem::copy_file(library("sound"), folder.path() / "mine.so");
  const std::vector<std::string> run = {"run", "s.json", "--plugin", "mine.so"};
  ASSERT_EQ(run_program(folder, run).exit_code, 0);
  EXPECT_EQ(run_program(folder, run).exit_code, 0);

  const auto unloaded = run_program(folder, {"report", "runs/s"});
  EXPECT_EQ(unloaded.exit_code, 2);
  EXPECT_THAT(unloaded.err, AllOf(HasSubstr("it was run with plug-ins that are not there: mine;"),
                                  HasSubstr("--plugin")));

  std::filesystem::remove(folder.path() / "mine.so");  // which is mapped by nobody any more
  std::filesystem::copy_file(library("sound_otherwise"), folder.path() / "mine.so");
  const auto refused = run_program(folder, run);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("holds outcomes of build"), HasSubstr("with mine ")));
  EXPECT_EQ(lines_of(refused.err), 1U);
  auto mixed = run;
  mixed.emplace_back("--mix");
  EXPECT_EQ(run_program(folder, mixed).exit_code, 0);
}

}  // namespace
}  // namespace gyrostat::plugins_test
