// Whatever is wrong with what goes in: exit code 2, one line on stderr that names place, value and
// what would do, nothing on stdout, and every file in the folder as it was before.

#include <cmath>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::bad_input_test {
namespace {

using Words = std::vector<std::string>;

/// What in `ended`, and in the files after it, breaks the law above; empty when nothing does.
Words breaches(const Ended& ended, const Words& parts,
               const std::map<std::string, std::string>& before,
               const std::map<std::string, std::string>& after) {
  Words found;
  const auto require = [&](bool holds, std::string breach) {
    if (!holds) found.push_back(std::move(breach));
  };
  require(ended.exit_code == 2, fmt::format("exit code {}", ended.exit_code));
  require(ended.out.empty(), "something on stdout");
  require(ended.err.starts_with("gyrostat: "), "does not start with 'gyrostat: '");
  require(ended.err.find('\n') + 1 == ended.err.size(), "not one line");
  for (const auto& part : parts) require(ended.err.find(part) != part.npos, "lacks: " + part);
  for (const auto& [name, bytes] : after) require(before.contains(name), "left behind: " + name);
  for (const auto& [name, bytes] : before)
    require(after.contains(name) && after.at(name) == bytes, "changed: " + name);
  return found;
}

void expect_refused(const TestFolder& folder, const Words& arguments, const Words& parts) {
  const auto before = folder.contents();
  const auto ended = run_program(folder, arguments);
  EXPECT_THAT(breaches(ended, parts, before, folder.contents()), testing::IsEmpty())
      << "gyrostat " << fmt::format("{}", fmt::join(arguments, " ")) << '\n'
      << ended.err;
}

/// "t_s,gyro_dps" with `samples` rows from line 2 on, of noise at 100 Hz.
std::string sound_recording(int samples = 1000) {
  std::string csv = "t_s,gyro_dps\n";
  for (int i = 0; i < samples; ++i)
    csv += fmt::format("{:.2f},{:.6f}\n", i / 100.0, 0.1 * std::sin(1e4 * std::sin(i + 1.0)));
  return csv;
}

/// The recording with `row` in place of line `line`.
std::string with_line(std::size_t line, const std::string& row) {
  std::string csv = sound_recording();
  std::size_t begin = 0;
  for (std::size_t i = 1; i < line; ++i) begin = csv.find('\n', begin) + 1;
  return csv.replace(begin, csv.find('\n', begin) - begin, row);
}

/// Hands `recording` (nothing: the file is absent) to every verb that reads one.
void expect_recording_refused(const std::optional<std::string>& recording, const Words& parts) {
  const TestFolder folder;
  if (recording) folder.write("rec.csv", *recording);
  folder.write("earlier.csv", "what an earlier call wrote");
  folder.write("around.json", R"({"cells": [{"trials": 2, "filters": ["none"], "scenario":
      {"duration_s": 10, "from_recording": {"file": "rec.csv"}}}]})");
  expect_refused(folder, {"fit", "rec.csv"}, parts);
  expect_refused(folder, {"apply", "rec.csv", "--out", "out.csv"}, parts);
  expect_refused(folder, {"apply", "rec.csv", "--out", "earlier.csv"}, parts);
  expect_refused(folder, {"allan", "rec.csv"}, parts);
  expect_refused(folder, {"validate", "around.json"}, parts);
  expect_refused(folder, {"run", "around.json", "--out", "out"}, parts);
  expect_refused(folder, {"simulate", "around.json", "--out", "out.csv"}, parts);
}

TEST(BadInput, TheSoundRecordingIsAccepted) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  for (const char* verb : {"fit", "apply", "allan"})
    EXPECT_EQ(run_program(folder, {verb, "rec.csv"}).exit_code, 0) << verb;
}

TEST(BadInput, AMissingRecordingIsNamed) {
  expect_recording_refused(std::nullopt, {"rec.csv", "No such file"});
}

TEST(BadInput, AnEmptyRecordingIsNamed) {
  expect_recording_refused("", {"rec.csv", "is empty"});
  expect_recording_refused("t_s,gyro_dps\n", {"rec.csv:2", "no samples"});
}

TEST(BadInput, AWrongHeaderIsToldWhatIsRequired) {
  expect_recording_refused("time_s,gyro_dps\n0,1\n",
                           {"rec.csv:1", "'t_s' is missing", "'time_s'", "required"});
  expect_recording_refused("t_s,gyro\n0,1\n", {"rec.csv:1", "'gyro_dps' is missing", "'gyro'"});
  expect_recording_refused("t_s,gyro_x_dps,gyro_y_dps\n0,1,2\n", {"rec.csv:1", "--axis"});
  expect_recording_refused("t_s,gyro_dps,gyro_dps\n0,1,2\n", {"rec.csv:1", "'gyro_dps'", "twice"});
}

TEST(BadInput, ACellThatIsNoNumberIsNamedByLineAndColumn) {
  expect_recording_refused(with_line(4, "0.02,abc"),
                           {"rec.csv:4", "'gyro_dps'", "'abc'", "finite numbers"});
  expect_recording_refused(with_line(4, "0.02,0.1.2"), {"rec.csv:4", "'0.1.2'"});
  expect_recording_refused(with_line(4, "0.02"), {"rec.csv:4", "cells"});
}

TEST(BadInput, ACellOutOfRangeIsToldTheRangeWithItsUnit) {
  const TestFolder folder;
  folder.write("rec.csv",
               "t_s,gyro_dps,temperature_C\n0,1,-300\n0.1,1,20\n0.2,2,20\n0.3,1,20\n0.4,1,20\n");
  expect_refused(folder, {"fit", "rec.csv"},
                 {"rec.csv:2", "'temperature_C'", "'-300'", "-273.15 to 1000 °C"});
}

TEST(BadInput, TimeGoingBackwardsIsNamedByLine) {
  expect_recording_refused(with_line(5, "0.01,1"), {"rec.csv:5", "'t_s'", "'0.01'", "'0.02'"});
  expect_recording_refused(with_line(5, "0.02,1"), {"rec.csv:5", "'t_s'", "'0.02'"});
}

/// The line is the file's own, whatever stands above the samples and from where on they are read.
/// Neither lost samples nor stamps of arrival: a rate that changes.
TEST(BadInput, ARateThatChangesIsToldItsRemedy) {
  std::string recording = "t_s,gyro_dps\n";
  for (int k = 0; k < 600; ++k)
    recording += fmt::format("{},{}\n", k < 300 ? 0.01 * k : 3.0 + 0.0137 * (k - 300), k % 7);
  expect_recording_refused(recording, {"rec.csv", "--resample"});
}

TEST(BadInput, ATruncatedOrCorruptGzipIsNamed) {
  const auto packed = gzipped(sound_recording());
  expect_recording_refused(packed.substr(0, packed.size() / 2), {"rec.csv", "gzip", "truncated"});
  auto flipped = packed;
  flipped[packed.size() - 8] ^= 0x55;
  expect_recording_refused(flipped, {"rec.csv", "gzip", "corrupt"});
}

TEST(BadInput, ARecordingTooShortToFitIsNamedWithWhatIsNeeded) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording(20));
  for (const Words& arguments :
       {Words{"fit", "rec.csv"}, Words{"apply", "rec.csv", "--out", "out.csv"}})
    expect_refused(folder, arguments, {"rec.csv", "samples", "at least 50"});
  folder.write("rec.csv", sound_recording(1));
  expect_refused(folder, {"allan", "rec.csv"}, {"rec.csv", "sample"});
}

TEST(BadInput, ARecordingThatNeverChangesCannotBeFitted) {
  const TestFolder folder;
  std::string csv = "t_s,gyro_dps\n";
  for (int i = 0; i < 1000; ++i) csv += fmt::format("{:.2f},0.5\n", i / 100.0);
  folder.write("rec.csv", csv);
  expect_refused(folder, {"fit", "rec.csv"}, {"rec.csv", "never changes"});
}

TEST(BadInput, ASpanOutsideTheRecordingIsToldItsLength) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  expect_refused(folder, {"fit", "rec.csv", "--from", "20"}, {"--from", "20 s", "9.99 s"});
  expect_refused(folder, {"fit", "rec.csv", "--from", "5", "--to", "3"}, {"--from", "--to"});
  expect_refused(folder, {"fit", "rec.csv", "--from", "nan"}, {"--from", "nan"});
  for (const char* no_span : {"3-4", "4:3", "-1:3", "3:", "x:4", "3:nan"})
    expect_refused(folder, {"fit", "rec.csv", "--leave-out", no_span},
                   {"--leave-out", no_span, "FROM:TO"});
  expect_refused(folder, {"fit", "rec.csv", "--leave-out", "20:30"},
                 {"rec.csv", "--leave-out", "20 s", "9.99 s"});
  expect_refused(folder, {"fit", "rec.csv", "--leave-out", "0:30"}, {"rec.csv", "no sample"});
}

Json sound_study() {
  return Json::parse(R"({"title": "sound", "seed": 1, "cells": [{"name": "a", "trials": 2,
      "scenario": {"duration_s": 10, "rate_hz": 50}, "filters": ["none", "kf"]}]})");
}

/// Hands `text` (nothing: the file is absent) to every verb that reads a study.
void expect_study_refused(const std::optional<std::string>& text, const Words& parts) {
  const TestFolder folder;
  if (text) folder.write("study.json", *text);
  folder.write("earlier/tables.md", "what an earlier run wrote");
  expect_refused(folder, {"validate", "study.json"}, parts);
  expect_refused(folder, {"run", "study.json"}, parts);
  expect_refused(folder, {"run", "study.json", "--out", "earlier"}, parts);
  expect_refused(folder, {"simulate", "study.json", "--out", "out.csv"}, parts);
}

/// The sound study with `value` at the JSON pointer `pointer`.
void expect_refused_with(const std::string& pointer, const Json& value, const Words& parts) {
  Json study = sound_study();
  study[Json::json_pointer(pointer)] = value;
  SCOPED_TRACE(pointer + " = " + value.dump());
  expect_study_refused(study.dump(1), parts);
}

TEST(BadInput, TheSoundStudyIsAccepted) {
  const TestFolder folder;
  folder.write("study.json", sound_study().dump());
  EXPECT_EQ(run_program(folder, {"validate", "study.json"}).exit_code, 0);
  EXPECT_EQ(run_program(folder, {"run", "study.json"}).exit_code, 0);
}

TEST(BadInput, AMissingStudyIsNamed) {
  expect_study_refused(std::nullopt, {"study.json", "no such file"});
}

TEST(BadInput, AnEmptyStudyIsNamed) {
  expect_study_refused("", {"study.json", "empty"});
  expect_study_refused("{}", {"study.json", "\"cells\" is missing"});
}

TEST(BadInput, MalformedJsonIsNamedByLine) {
  expect_study_refused("{\n \"seed\": 1,\n \"cells\": [,]\n}", {"study.json:3", "JSON"});
  expect_study_refused("{\n \"seed\": 1,\n \"cells\": [", {"study.json:3", "JSON"});
  expect_study_refused("{\n \"seed\": 1e999, \"cells\": [{}]}", {"study.json:2", "1e999"});
}

TEST(BadInput, AKeyThatStandsTwiceIsNamed) {
  expect_study_refused(R"({"seed": 1, "cells": [{"trials": 1, "trials": 2, "filters": ["none"]}]})",
                       {"study.json: cells[0].trials", "twice"});
}

TEST(BadInput, AnUnknownKeyIsToldItsPathAndTheNearestKnown) {
  expect_refused_with("/sed", 1, {"study.json: ", "'sed'", "'seed'"});
  expect_refused_with("/cells/0/trial", 1, {"cells[0]", "'trial'", "'trials'"});
  expect_refused_with("/cells/0/scenario/durations", 1,
                      {"cells[0].scenario", "'durations'", "'duration_s'"});
  expect_refused_with("/cells/0/scenario/random_error", {{"fi", 0.1}},
                      {"cells[0].scenario.random_error", "'fi'", "'phi'"});
  expect_refused_with("/cells/0/scenario/compass", {{"noise_deg", 0.1}},
                      {"cells[0].scenario.compass", "'noise_deg'", "'noise_std_deg'"});
  expect_refused_with("/cells/0/scenario/temperature", {{"profil", "cycle"}},
                      {"cells[0].scenario.temperature", "'profil'", "'profile'"});
  expect_refused_with("/cells/0/scenario/from_recording", {{"fil", "rec.csv"}},
                      {"cells[0].scenario.from_recording", "'fil'", "'file'"});
  expect_refused_with("/cells/0/calibration", {{"duration", 10}},
                      {"cells[0].calibration", "'duration'", "'duration_s'"});
  expect_refused_with("/cells/0/filters/1", {{"filter", "kf"}, {"params", Json::object()}},
                      {"cells[0].filters[1]", "'params'", "'parameters'"});
  expect_refused_with("/cells/0/filters/1", {{"filter", "stf"}, {"parameters", {{"fading", 2}}}},
                      {"cells[0].filters[1].parameters", "'fading'", "'fading_factor'"});
}

TEST(BadInput, NoPathEndsInTwoColons) {
  const TestFolder folder;
  folder.write("study.json", R"({"sed": 1, "cells": [{}]})");
  EXPECT_THAT(run_program(folder, {"validate", "study.json"}).err,
              testing::StartsWith("gyrostat: study.json: unknown key"));
}

TEST(BadInput, AValueOutOfRangeIsToldItsPathUnitAndRange) {
  expect_refused_with("/seed", -1, {"seed", "-1", "[0, "});
  expect_refused_with("/cells/0/trials", 0, {"cells[0].trials", "0", "[1, ", "whole"});
  expect_refused_with("/cells/0/trials", 1.5, {"cells[0].trials", "1.5", "whole"});
  expect_refused_with("/cells/0/scenario/duration_s", 0,
                      {"cells[0].scenario.duration_s", "0 s", "(0, ", " s"});
  expect_refused_with("/cells/0/scenario/random_error", {{"phi", 1}},
                      {"cells[0].scenario.random_error.phi", "1", "(-1, 1)"});
  expect_refused_with("/cells/0/scenario/temperature", {{"profile", "cycle"}, {"period_s", -1}},
                      {"cells[0].scenario.temperature.period_s", "-1 s", "(0, inf) s"});
  expect_refused_with("/cells/0/scenario/effects", {{{"effect", "outliers"}, {"probability", 2}}},
                      {"cells[0].scenario.effects[0].probability", "2", "[0, 1]"});
  expect_refused_with("/cells/0/scenario/compass", {{"disturbances", {{{"start_s", -1}}}}},
                      {"cells[0].scenario.compass.disturbances[0].start_s", "-1 s", "[0, inf) s"});
  expect_refused_with("/cells/0/filters/1",
                      {{"filter", "kf"}, {"parameters", {{"delta1_dps", -0.1}}}},
                      {"cells[0].filters[1].parameters.delta1_dps", "-0.1 dps", "[0, inf) dps"});
}

TEST(BadInput, AStudyTooLargeForAnyMachineIsOutOfRange) {
  expect_refused_with("/cells/0/scenario/duration_s", 1e12, {"cells[0].scenario", "duration_s"});
  expect_refused_with("/cells/0/scenario/rate_hz", 1e300, {"cells[0].scenario", "rate_hz"});
}

TEST(BadInput, MoreTrialsThanMemoryHoldsAreOutOfRange) {
  const TestFolder folder;
  Json study = sound_study();
  study["cells"][0]["trials"] = 4e9;
  folder.write("study.json", study.dump());
  expect_refused(folder, {"validate", "study.json"}, {"cells[0].trials", "[1, "});
}

TEST(BadInput, AScenarioWhoseSignalNoRecordingMayHoldIsOutOfRange) {
  expect_refused_with("/cells/0/scenario/temperature", {{"profile", "cycle"}, {"low_C", -300}},
                      {"cells[0].scenario.temperature.low_C", "-300 °C", "-273.15"});
}

TEST(BadInput, AScenarioTooShortToCalibrateOnIsRefusedBeforeTheRun) {
  const TestFolder folder;
  Json study = sound_study();
  study["cells"][0]["scenario"]["duration_s"] = 0.1;
  folder.write("study.json", study.dump());
  expect_refused(folder, {"validate", "study.json"}, {"study.json: cells[0]", "samples"});
  expect_refused(folder, {"run", "study.json"}, {"study.json: cells[0]", "samples"});
}

TEST(BadInput, AWrongTypeIsToldWhatIsNeeded) {
  expect_study_refused("[1]", {"study.json", "object"});
  expect_refused_with("/title", 1, {"title", "1", "text"});
  expect_refused_with("/seed", "1", {"seed", "\"1\"", "number"});
  expect_refused_with("/cells", Json::object(), {"cells", "list"});
  expect_refused_with("/cells/0", 1, {"cells[0]", "object"});
  expect_refused_with("/cells/0/scenario/duration_s", nullptr,
                      {"cells[0].scenario.duration_s", "null", "number"});
  expect_refused_with("/cells/0/scenario/effects", Json::object(),
                      {"cells[0].scenario.effects", "list"});
  expect_refused_with("/cells/0/filters", "kf", {"cells[0].filters", "list"});
  expect_refused_with("/cells/0/filters", Json::array(), {"cells[0].filters", "empty"});
  expect_refused_with("/cells/0/filters/1", 1, {"cells[0].filters[1]", "object"});
}

TEST(BadInput, AnUnknownPluginIsToldTheNearest) {
  expect_refused_with("/cells/0/filters/1", "sr_ufk",
                      {"cells[0].filters[1]", "filter 'sr_ufk'", "'sr_ukf'"});
  expect_refused_with("/cells/0/filters/1", {{"id", "mine"}, {"filter", "thermal_sft"}},
                      {"cells[0].filters[1].filter", "filter 'thermal_sft'", "'thermal_stf'"});
  expect_refused_with("/cells/0/scenario/effects", {{{"effect", "outlier"}}},
                      {"cells[0].scenario.effects[0].effect", "effect 'outlier'", "'outliers'"});
  expect_refused_with("/cells/0/scenario/temperature", {{"profile", "quiet_rom"}},
                      {"cells[0].scenario.temperature.profile", "'quiet_rom'", "'quiet_room'"});
  expect_refused_with("/cells/0/scenario/motion", {{"profile", "rate_tabel"}},
                      {"cells[0].scenario.motion.profile", "'rate_tabel'", "'rate_table'"});
  expect_refused_with("/cells/0/calibration", {{"fit", "likelyhood"}},
                      {"cells[0].calibration.fit", "'likelyhood'", "'likelihood'"});
  expect_refused_with("/cells/0/filters/1", {{"filter", "kf"}, {"parameters_from", "true"}},
                      {"cells[0].filters[1].parameters_from", "'true'", "'truth'"});
  expect_refused_with("/cells/0/tuning", {{"metric", "bias_rms"}},
                      {"cells[0].tuning.metric", "metric 'bias_rms'", "'bias_rmse'"});
  expect_refused_with("/cells/0/assumed", {{"delta1", 2}},
                      {"cells[0].assumed", "'delta1'", "'delta1_dps'"});
}

/// The lines on stderr of `gyrostat <arguments>`, which must end with exit code 2.
Words lines_of(const TestFolder& folder, const Words& arguments) {
  const auto ended = run_program(folder, arguments);
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_THAT(ended.out, testing::IsEmpty());
  std::istringstream text(ended.err);
  Words lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST(BadInput, AllMistakesOfAStudyAreToldAtOnce) {
  const TestFolder folder;
  folder.write("study.json", R"({
    "sed": 1, "title": 3, "failure_budget": 2, "title": "again",
    "cells": [
      {"name": "a", "trials": 0, "trails": 5, "scenario": {
         "duration_s": 0, "rate": 50,
         "random_error": {"phi": 2, "delta": 1},
         "motion": {"profile": "rate_tabel"},
         "temperature": {"profile": "cycle", "period_s": 0},
         "from_recording": {"file": "absent.csv", "axis": 3},
         "compass": {"disturbances": [{"start_s": 1}, {"start_s": -1}]},
         "effects": [{"effect": "outlier"}, {"effect": "outliers", "probability": 2, "std": 1}]},
       "calibration": {"fit": "likelyhood", "duration": 3},
       "tuning": {"metric": "bias_rms", "trials": 0},
       "assumed": {"delta1": 2},
       "filters": ["kv", "kf", "kf", {"filter": "stf", "id": "x,y", "parameters": {"forgetting": 2},
                                      "tune": {"forgetting": [0.9, 0.1]}, "parameters_from": "true"}]},
      7,
      {"name": "b", "filters": []},
      {"name": "a", "grid": {"trials": []}}]})");
  const Words expected = {
      "title: the key stands twice",
      "failure_budget: 2 of all trials is out of range; allowed: [0, 1]",
      "cells[0].trials: 0 trials is out of range; allowed: [1, 1e8] trials, whole numbers",
      "cells[0]: unknown key 'trails'; did you mean 'trials'?",
      "cells[0].scenario.from_recording.axis: 3 is not a text",
      "absent.csv",
      "cells[0].scenario.duration_s: 0 s is out of range; allowed: (0, 1e7] s",
      "cells[0].scenario: unknown key 'rate'; did you mean 'rate_hz'?",
      "cells[0].scenario.random_error.phi: 2 is out of range; allowed: (-1, 1)",
      "cells[0].scenario.random_error: unknown key 'delta'",
      "cells[0].scenario.motion.profile: unknown profile 'rate_tabel'; did you mean 'rate_table'?",
      "cells[0].scenario.temperature.period_s: 0 s is out of range; allowed: (0, inf) s",
      "cells[0].scenario.compass.disturbances[1].start_s: -1 s is out of range; allowed: [0, inf) "
      "s",
      "cells[0].scenario.effects[0].effect: unknown effect 'outlier'; did you mean 'outliers'?",
      "cells[0].scenario.effects[1].probability: 2 is out of range; allowed: [0, 1]",
      "cells[0].scenario.effects[1]: unknown key 'std'; did you mean 'std_dps'?",
      "cells[0].calibration.fit: unknown",
      "cells[0].calibration: unknown key 'duration'; did you mean 'duration_s'?",
      "cells[0].tuning.metric: unknown metric 'bias_rms'",
      "cells[0].tuning.trials: 0 trials is out of range",
      "cells[0].assumed: unknown key 'delta1'",
      "cells[0].filters[0]: unknown filter 'kv'; did you mean 'kf'?",
      "cells[0].filters[2]: the id 'kf' stands twice",
      "cells[0].filters[3].id: 'x,y'",
      "cells[0].filters[3].parameters.forgetting: 2 is out of range; allowed: [0, 1]",
      "cells[0].filters[3].tune.forgetting: the lower bound",
      "cells[0].filters[3].parameters_from: unknown",
      "cells[1]: an object",
      "cells[2].filters: the list is empty",
      "cells[3].grid.trials: a list",
      "study.json: unknown key 'sed'; did you mean 'seed'?"};
  for (const Words& verb : {Words{"validate", "study.json"}, Words{"run", "study.json"}}) {
    const auto lines = lines_of(folder, verb);
    for (const auto& line : lines) EXPECT_THAT(line, testing::StartsWith("gyrostat: "));
    for (const auto& mistake : expected) {
      const auto tells = [&](const auto& line) { return line.find(mistake) != line.npos; };
      EXPECT_EQ(std::ranges::count_if(lines, tells), 1)
          << mistake << '\n'
          << fmt::format("{}", fmt::join(lines, "\n"));
    }
    EXPECT_EQ(lines.size(), expected.size()) << fmt::format("{}", fmt::join(lines, "\n"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "runs"));
}

TEST(BadInput, AMistakeThatAllCellsOfAGridShareIsToldOnce) {
  const TestFolder folder;
  folder.write("study.json", R"({"cells": [{"trails": 5, "filters": ["kv"],
      "grid": {"scenario.random_error.phi": [0.1, 0.5, 2], "trials": [1, 2]}}]})");
  const auto lines = lines_of(folder, {"validate", "study.json"});
  ASSERT_EQ(lines.size(), 3U) << fmt::format("{}", fmt::join(lines, "\n"));
  EXPECT_THAT(lines[0], testing::HasSubstr("cells[0].filters[0]: unknown filter 'kv'"));
  EXPECT_THAT(lines[1], testing::HasSubstr("cells[0]: unknown key 'trails'"));
  EXPECT_THAT(lines[2],
              testing::HasSubstr("cells[0].scenario.random_error.phi: 2 is out of range"));
}

TEST(BadInput, AllMistakesOfADesignAreToldAtOnce) {
  const TestFolder folder;
  folder.write("study.json", R"({"cells": [
      {"name": "a", "trails": 5, "filters": ["kf"], "design": {"kind": "morris", "trajectories": 0, "levels": 5, "seed": 1,
        "parameters": {"scenario.random_error.phy": {"from": 0, "to": 0.5},
                       "scenario.random_error.phi": {"from": 2, "to": "x", "scale": "lin", "step": 1},
                       "scenario.random_error.delta1_dps": {"from": 0, "to": 1, "scale": "log"}}}},
      {"name": "b", "filters": ["kf"], "design": {"kind": "one_at_a_time", "parameters": {
        "scenario.random_error.phi": {"from": 0.5, "to": 0.4, "base": 3}}}},
      {"name": "c", "filters": ["kf"], "design": {"kind": "grid", "parameters": {
        "scenario.random_error.phi": {"from": 0.1, "to": 0.4, "levels": 1}, "trials": []}}}]})");
  const auto lines = lines_of(folder, {"validate", "study.json"});
  const Words expected = {
      "cells[0]: unknown key 'trails'",
      "cells[0].design.parameters.scenario.random_error.phy: ",
      "cells[0].design.parameters.scenario.random_error.phi.from: 2 is out of range; allowed: (-1, "
      "1)",
      "cells[0].design.parameters.scenario.random_error.phi.to: \"x\" is not a number",
      "cells[0].design.parameters.scenario.random_error.phi.scale: unknown scale 'lin'",
      "cells[0].design.parameters.scenario.random_error.phi: unknown key 'step'",
      "cells[0].design.parameters.scenario.random_error.delta1_dps.from: 0 dps has no logarithm",
      "cells[0].design.trajectories: 0 trajectories is out of range",
      "cells[0].design.levels: 5 is odd",
      "cells[0].design: unknown key 'seed'",
      "cells[1].design.parameters.scenario.random_error.phi: \"from\" 0.5 is not below",
      "cells[1].design.parameters.scenario.random_error.phi.base: 3 is out of range",
      "cells[2].design.parameters.scenario.random_error.phi.levels: 1 levels is out of range",
      "cells[2].design.parameters.trials: a list of values"};
  for (const auto& mistake : expected) {
    const auto tells = [&](const auto& line) { return line.find(mistake) != line.npos; };
    EXPECT_EQ(std::ranges::count_if(lines, tells), 1) << mistake;
  }
  EXPECT_EQ(lines.size(), expected.size()) << fmt::format("{}", fmt::join(lines, "\n"));
}

TEST(BadInput, AllMistakesOfAConfigAreToldAtOnce) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  folder.write(
      "config.json",
      R"({"filters": ["kv", {"filter": "kf", "parameters": {"phi": 2, "fi": 1}}], "out": 1})");
  EXPECT_EQ(lines_of(folder, {"apply", "rec.csv", "--config", "config.json"}).size(), 4U);
}

TEST(BadInput, AFolderWithoutARunIsNamed) {
  const TestFolder folder;
  folder.write("empty/notes.txt", "nothing here");
  for (const Words& arguments : {Words{"status", "empty"}, Words{"export", "empty"},
                                 Words{"export", "absent"}, Words{"merge", "all", "empty"}})
    expect_refused(folder, arguments,
                   {arguments.back(), "holds no outcomes", "store.db", "runs/STUDY"});
}

TEST(BadInput, AReplayOfATrialThatThereIsNotIsToldTheRange) {
  const TestFolder folder;
  folder.write("study.json", sound_study().dump());
  for (const std::string trial : {"2", "99999", "99999999999", "-1", "x"})
    expect_refused(folder, {"replay", "study:a:" + trial + ":kf", "--study", "study.json"},
                   {"study:a:" + trial, trial});
  expect_refused(folder, {"replay", "study:a:2:kf", "--study", "study.json"}, {"0 to 1", "'a'"});
  EXPECT_EQ(run_program(folder, {"run", "study.json", "--trials", "4"}).exit_code, 0);
  EXPECT_EQ(run_program(folder, {"replay", "study:a:3:kf", "--study", "study.json"}).exit_code, 0);
}

TEST(BadInput, AGridThatLeadsNowhereIsNamed) {
  expect_refused_with("/cells/0/grid", Json::array({1}), {"cells[0].grid", "object"});
  expect_refused_with("/cells/0/grid", {{"trials", 3}}, {"cells[0].grid.trials", "list"});
  expect_refused_with("/cells/0/grid", {{"trials.x", {3}}}, {"cells[0].grid", "trials.x"});
  expect_refused_with("/cells/0/grid", {{"filters.7", {"kf"}}}, {"cells[0].grid", "filters.7"});
  expect_refused_with("/cells/0/grid", {{"scenario.durations", {3}}},
                      {"cells[0]", "'durations'", "'duration_s'"});
  expect_refused_with("/cells/0/grid", {{"trials", {3, 0}}}, {"cells[0]", "trials", "0", "[1, "});
  expect_refused_with("/cells/0/grid", {{"trials", {3, 3}}}, {"cells[0]", "trials=3", "twice"});
  expect_refused_with("/cells/0", {{"name", 1}, {"grid", {{"trials", {1, 2}}}}},
                      {"cells[0].name", "1", "text"});
}

TEST(BadInput, AnIdThatStandsTwiceIsNamed) {
  expect_refused_with("/cells/0/filters/1", "none", {"cells[0].filters[1]", "'none'", "twice"});
  expect_refused_with("/cells/1", sound_study()["cells"][0], {"cells[1]", "'a'", "twice"});
}

TEST(BadInput, AnIdThatCannotBeAColumnNameIsNamed) {
  for (const std::string id : {"", "a,b", "a\nb", "a\"b"})
    expect_refused_with("/cells/0/filters/1", {{"id", id}, {"filter", "kf"}},
                        {"cells[0].filters[1].id"});
  expect_refused_with("/cells/0/name", "a\nb", {"cells[0].name"});
}

TEST(BadInput, ARecordingThatAStudyNeedsIsNamed) {
  expect_refused_with("/cells/0/scenario/from_recording", {{"file", "absent.csv"}},
                      {"absent.csv", "No such file"});
  expect_refused_with("/cells/0/scenario/temperature", {{"profile", "recorded"}},
                      {"cells[0].scenario.temperature", "from_recording"});

  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  Json study = sound_study();
  study["cells"][0]["scenario"]["from_recording"] = {{"file", "rec.csv"}, {"axis", "x"}};
  folder.write("study.json", study.dump());
  expect_refused(folder, {"validate", "study.json"}, {"rec.csv:1", "'gyro_x_dps' is missing"});
  study["cells"][0]["scenario"]["from_recording"] = {{"file", "rec.csv"}, {"from_s", 100}};
  folder.write("study.json", study.dump());
  expect_refused(folder, {"validate", "study.json"},
                 {"cells[0].scenario.from_recording", "100 s", "9.99 s"});
  study["cells"][0]["scenario"]["from_recording"] = {{"file", "rec.csv"}};
  study["cells"][0]["scenario"]["random_error"]["measurement_noise_std_dps"] = 0;
  folder.write("study.json", study.dump());
  expect_refused(folder, {"validate", "study.json"},
                 {"cells[0].scenario", "cannot tell R", "measurement_noise_std_dps", "above 0"});
}

/// `config` as the file that `apply --config` reads.
void expect_config_refused(const std::string& config, const Words& parts) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  folder.write("config.json", config);
  expect_refused(folder, {"apply", "rec.csv", "--config", "config.json", "--out", "out.csv"},
                 parts);
}

TEST(BadInput, AConfigOfApplyIsReadAsStrictlyAsAStudy) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  expect_refused(folder, {"apply", "rec.csv", "--config", "absent.json"},
                 {"absent.json", "no such file"});
  expect_config_refused("", {"config.json", "empty"});
  expect_config_refused("{\n\"filters\": [}", {"config.json:2", "JSON"});
  expect_config_refused("{}", {"config.json", "\"filters\" is missing"});
  expect_config_refused(R"({"filter": ["kf"]})", {"config.json: ", "'filter'", "'filters'"});
  expect_config_refused(R"({"filters": ["kv"]})", {"config.json: filters[0]", "'kv'", "'kf'"});
  expect_config_refused(R"({"filters": ["kf", "kf"]})", {"filters[1]", "'kf'", "twice"});
  expect_config_refused(R"({"filters": [{"filter": "stf", "parameters": {"forgetting": 2}}]})",
                        {"config.json: filters[0].parameters.forgetting", "2", "[0, 1]"});
  expect_config_refused(R"({"filters": [{"filter": "kf", "parameters": {"phi": "high"}}]})",
                        {"filters[0].parameters.phi", "\"high\"", "number"});
}

TEST(BadInput, AConfigCannotAskForParametersThatThereAreNot) {
  for (const std::string source : {"truth", "calibration"})
    expect_config_refused(
        R"({"filters": [{"filter": "kf", "parameters_from": ")" + source + "\"}]}",
        {"filters[0].parameters_from", source});
}

TEST(BadInput, AConfigOfWhichNothingCanRunOnTheRecordingIsRefused) {
  expect_config_refused(R"({"filters": ["thermal_kf", "oracle"]})",
                        {"rec.csv", "thermal_kf", "temperature_C"});
}

TEST(BadInput, OptionsOfAFitHaveNoPlaceBesideAConfig) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  folder.write("config.json", R"({"filters": ["kf"]})");
  for (const Words& option : {Words{"--calibration", "0.5"}, Words{"--fit", "moments"}})
    expect_refused(folder, {"apply", "rec.csv", "--config", "config.json", option[0], option[1]},
                   {option[0], "--config"});
}

TEST(BadInput, ABrokenStudyInTheListedFolderIsNamed) {
  for (const char* text : {"{", "[1]", R"({"title": 5})"}) {
    const TestFolder folder;
    folder.write("studies/broken.json", text);
    expect_refused(folder, {"list", "studies", "--studies", "studies"}, {"studies/broken.json"});
  }
  expect_refused(TestFolder(), {"list", "studies", "--studies", "absent"}, {"absent"});
}

TEST(BadInput, ANameOnTheCommandLineIsToldTheNearest) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  folder.write("study.json", sound_study().dump());
  for (const Words& verb : {Words{"fit", "rec.csv"}, Words{"apply", "rec.csv"},
                            Words{"allan", "rec.csv"}, Words{"run", "study.json"}}) {
    auto arguments = verb;
    arguments.insert(arguments.end(), {"--format", "jsn"});
    expect_refused(folder, arguments, {"--format", "'jsn'", "'json'"});
  }
  expect_refused(folder, {"fit", "rec.csv", "--method", "moment"}, {"--method", "'moments'"});
  expect_refused(folder, {"apply", "rec.csv", "--fit", "moment"}, {"--fit", "'moments'"});
  expect_refused(folder, {"simulate", "study.json", "--cell", "b", "--out", "out.csv"},
                 {"--cell", "'b'", "'a'"});
  expect_refused(folder, {"list", "filers"}, {"'filers'", "'filters'"});
  expect_refused(folder, {"runn", "study.json"}, {"'runn'", "'run'"});
  expect_refused(folder, {"run", "study.json", "--thread", "2"}, {"--thread"});
}

TEST(BadInput, AnOptionOutOfRangeIsToldTheRange) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  folder.write("study.json", sound_study().dump());
  expect_refused(folder, {"run", "study.json", "--threads", "0"},
                 {"--threads: '0' is out of range; allowed: whole numbers from 1 to 1024"});
  expect_refused(
      folder, {"run", "study.json", "--trials", "ten"},
      {"--trials: 'ten' is no whole number; allowed: whole numbers from 1 to 4294967295"});
  for (const char* trial : {"-1", "1.5", "4294967296", "99999999999999999999"})
    expect_refused(folder, {"simulate", "study.json", "--trial", trial, "--out", "out.csv"},
                   {"--trial", trial, "whole numbers from 0 to 4294967295"});
  expect_refused(folder, {"fit", "rec.csv", "--to", "q"},
                 {"--to: 'q' is no number; allowed: [0, 1e12] s"});
  expect_refused(folder, {"run", "study.json", "--lanes", "3"},
                 {"--lanes", "'3'", "allowed: 1, 2, 4, 8 or 16"});
  for (const char* fraction : {"0", "1", "nan"})
    expect_refused(folder, {"apply", "rec.csv", "--calibration", fraction},
                   {"--calibration", fraction, "0.01", "0.99"});
}

/// The lines of a text that begin so, without the beginning.
Words lines_after(const std::string& text, const std::string& begin) {
  Words found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(begin)) found.push_back(line.substr(begin.size()));
  return found;
}

// By the help of every verb, so that an option yet to come is held to it, too.
TEST(BadInput, EveryNumericOptionOfEveryVerbIsToldWhatIsExpected) {
  const TestFolder folder;
  std::size_t options = 0;
  for (auto verb : lines_after(run_program(folder, {"--help"}).out, "  ")) {
    verb = verb.substr(0, verb.find(' '));
    if (verb.empty() || verb.starts_with('-')) continue;
    for (const auto& line : lines_after(run_program(folder, {verb, "--help"}).out, "  --")) {
      const auto option = "--" + line.substr(0, line.find_first_of(" ,"));
      const auto type = line.substr(std::min(line.size(), option.size() - 1));
      const bool is_numeric = std::ranges::any_of(
          Words{"INT", "FLOAT", "HZ"},
          [&](const auto& name) { return type.starts_with(name) || type.starts_with("U" + name); });
      if (!is_numeric) continue;
      ++options;
      expect_refused(folder, {verb, "x", option, "q"}, {option + ": 'q' is no ", "; allowed: "});
    }
  }
  EXPECT_GT(options, 50U);
}

TEST(BadInput, AMissingArgumentIsNamed) {
  const TestFolder folder;
  folder.write("study.json", sound_study().dump());
  expect_refused(folder, {}, {"--help"});
  for (const char* verb : {"fit", "apply", "allan"}) expect_refused(folder, {verb}, {"recording"});
  for (const char* verb : {"run", "validate"}) expect_refused(folder, {verb}, {"study"});
  expect_refused(folder, {"simulate", "study.json"}, {"--out"});
  expect_refused(folder, {"run", "study.json", "surplus"}, {"surplus"});
}

TEST(BadInput, AnUnwritableOutIsNoticedAtOnce) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  folder.write("study.json", sound_study().dump());
  std::filesystem::create_directory(folder.path() / "folder");
  for (const std::string out : {"absent/out.csv", "rec.csv/out.csv", "folder"}) {
    expect_refused(folder, {"apply", "rec.csv", "--out", out}, {out, "cannot be written"});
    expect_refused(folder, {"simulate", "study.json", "--out", out}, {out, "cannot be written"});
  }
  for (const std::string out : {"rec.csv", "rec.csv/out", "/proc/gyrostat"})
    expect_refused(folder, {"run", "study.json", "--out", out}, {out, "cannot be created"});
}

TEST(BadInput, ARecordingIsNotOverwrittenByItsOwnCompensation) {
  const TestFolder folder;
  folder.write("rec.csv", sound_recording());
  expect_refused(folder, {"apply", "rec.csv", "--out", "rec.csv"}, {"rec.csv"});
  expect_refused(folder, {"apply", "rec.csv", "--out", "./rec.csv"}, {"rec.csv"});
}

TEST(BadInput, Diagnosis) {
  TestFolder folder;
  folder.write("rec.csv", sound_recording(2000));
  folder.write("short.csv", sound_recording(10));
  expect_refused(folder, {"diagnose", "missing.csv"}, {"missing.csv"});
  expect_refused(folder, {"diagnose", "short.csv"}, {"short.csv", "10 samples", "at least 1000"});
  expect_refused(folder, {"diagnose", "rec.csv", "--without", "outlier"}, {"outlier", "outliers"});
  expect_refused(folder, {"diagnose", "rec.csv", "--format", "html"}, {"html"});
  expect_refused(folder, {"diagnose", "rec.csv", "--claim", "absent.json"}, {"absent.json"});
  expect_refused(folder, {"diagnose", "rec.csv", "--json", "nowhere/out.json"}, {"nowhere"});
  expect_refused(folder,
                 {"diagnose", "rec.csv", "--json", "out.json", "--scenario", "nowhere/s.json"},
                 {"nowhere"});
}

TEST(BadInput, BlindCheck) {
  TestFolder folder;
  const auto refused = [&](const std::string& json, const Words& parts) {
    folder.write("check.json", json);
    expect_refused(folder, {"blind-check", "check.json"}, parts);
  };
  refused(R"({"title": "x"})", {"check.json", "scenarios"});
  refused(R"({"scenarios": {"a": {}}, "record": 3})", {"record", "recordings"});
  refused(
      R"({"scenarios": {"a": {}}, "cases": [{"effect": "outlier", "scenario": "a", "strong": {}}]})",
      {"cases[0]", "outlier", "outliers"});
  refused(
      R"({"scenarios": {"a": {}}, "cases": [{"effect": "outliers", "scenario": "b", "strong": {}}]})",
      {"cases[0].scenario", "'b'", "'a'"});
  refused(
      R"({"scenarios": {"a": {}}, "cases": [{"effect": "outliers", "scenario": "a", "strong": {"probability": 2}}]})",
      {"probability", "2", "[0, 1]"});
  refused(R"({"scenarios": {"a": {}}, "cases": [{"effect": "outliers", "scenario": "a"}]})",
          {"cases[0]", "strong"});
  const auto in_a = [](const std::string& rest) {
    return R"({"scenarios": {"a": {}}, "cases": [{"effect": "outliers", "scenario": "a", "strong": {}}],)" +
           rest + "}";
  };
  refused(in_a(R"("sets": [{"scenario": "a", "sizes": [1]}])"),
          {"sets[0].sizes[0]", "1", "[2, 10]"});
  refused(in_a(R"("sets": [{"scenario": "a", "strengths": ["strng"]}])"),
          {"sets[0].strengths[0]", "'strng'", "'strong'"});
  refused(in_a(R"("sets": [{"scenario": "a", "sizes": [2]}])"), {"'a'", "2 effects"});
  refused(in_a(R"("never_together": [["outliers", "outlier"]])"),
          {"never_together[0]", "outlier", "outliers"});
  refused(in_a(R"("samplings": [{"duration_s": -1}])"), {"samplings[0].duration_s", "-1", "s"});
  refused(
      R"({"scenarios": {"a": {}}, "cases": [{"effect": "outliers", "form": "truncation", "scenario": "a", "strong": {}}]})",
      {"cases[0].form", "truncation", "quantization"});
  refused(R"({"scenarios": {"a": {"noise": {"files": ["absent.csv"]}}}})", {"absent.csv"});
  refused(R"({"scenarios": {"a": {"rate_hz": 20, "noise": {"files": ["absent.csv"]}}}})",
          {"scenarios.a.rate_hz", "noise"});
  refused(
      R"({"scenarios": {"a": {"own": ["outliers"]}}, "cases": [{"effect": "outliers", "scenario": "a", "strong": {}}]})",
      {"cases[0].effect", "outliers", "of its own"});
}

TEST(BadInput, BlindCheckOfOthers) {
  TestFolder folder;
  folder.write("full/file", "");
  folder.write("check.json", R"({"scenarios": {"a": {"duration_s": 60}}, "none_recordings": 1})");
  const std::string key(64, '0');
  expect_refused(folder, {"blind-check", "check.json", "--export", "full"}, {"full", "new folder"});
  expect_refused(folder, {"blind-check", "check.json", "--seed", "3"}, {"--export"});
  expect_refused(folder, {"blind-check", "full", "--score", "answers"}, {"--key"});
  expect_refused(folder, {"blind-check", "full", "--score", "answers", "--key", key},
                 {"sealed_labels.bin", "--export"});
  folder.write("full/sealed_labels.bin", std::string(100, 'x'));
  expect_refused(folder, {"blind-check", "full", "--score", "answers", "--key", "12"},
                 {"--key", "'12'", "64"});
  expect_refused(folder, {"blind-check", "full", "--score", "answers", "--key", key},
                 {"sealed_labels.bin", "does not open"});
}

}  // namespace
}  // namespace gyrostat::bad_input_test
