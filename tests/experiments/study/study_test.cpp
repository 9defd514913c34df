#include <gyrostat/experiments/study/study.hpp>

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/generators/effect.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::study_test {
namespace {

using testing::ElementsAre;
using testing::Pair;

Study study_of(const TestFolder& folder, const std::string& json) {
  folder.write("study.json", json);
  return read_study((folder.path() / "study.json").string());
}

Study study_of(const std::string& json) { return study_of(TestFolder(), json); }

TEST(Study, WhatItDoesNotSayHasTheDefaultsOfTheStructs) {
  const auto study = study_of(R"({"cells": [{}, {}]})");
  EXPECT_EQ(study.title, "study");
  EXPECT_EQ(study.seed, Study{}.seed);
  ASSERT_EQ(study.cells.size(), 2);
  const auto& cell = study.cells[1];
  EXPECT_EQ(cell.name, "cell_2");
  EXPECT_EQ(cell.trials, Cell{}.trials);
  EXPECT_EQ(cell.scenario.sampling.samples(), Sampling{}.samples());
  EXPECT_EQ(cell.scenario.random_error.phi, Arima111<double>{}.phi);
  EXPECT_FALSE(cell.calibration.each_trial);
}

TEST(Study, WithoutAListOfFiltersEveryFilterStandsThatIsNoSimulation) {
  const auto study = study_of(R"({"cells": [{}]})");
  std::vector<std::string> ids;
  for (const auto& method : study.cells[0].methods) ids.push_back(method.id);
  std::vector<std::string> expected;
  for (const auto& id : filter_types().ids())
    if (id != "particle") expected.push_back(id);
  EXPECT_THAT(ids, testing::UnorderedElementsAreArray(expected));
}

TEST(Study, TheOracleIsToldTheTruthTheOthersTheCalibrationUnlessTheFileSaysElse) {
  const auto study = study_of(R"({"cells": [{"filters": ["kf", "oracle",
      {"id": "kf_told", "filter": "kf", "parameters_from": "truth"},
      {"id": "kf_plain", "filter": "kf", "parameters_from": "defaults"}]}]})");
  std::vector<ParameterSource> sources;
  for (const auto& method : study.cells[0].methods) sources.push_back(method.source);
  EXPECT_THAT(sources, ElementsAre(ParameterSource::calibration, ParameterSource::truth,
                                   ParameterSource::truth, ParameterSource::defaults));
}

TEST(Study, OverridesAreTheParametersThatTheFileGivesAndNoOthers) {
  const auto study = study_of(R"({"cells": [{"filters": [{"id": "slow", "filter": "stf",
      "parameters": {"fading_factor": 1, "forgetting": 0.5}}]}]})");
  const auto& method = study.cells[0].methods.at(0);
  EXPECT_EQ(method.id, "slow");
  EXPECT_EQ(method.filter, "stf");
  EXPECT_THAT(method.overrides, ElementsAre(Pair("fading_factor", 1), Pair("forgetting", 0.5)));
}

TEST(Study, EveryPluginCanBeChosenByItsName) {
  for (const auto& id : effect_types().ids()) {
    const auto study =
        study_of(R"({"cells": [{"scenario": {"effects": [{"effect": ")" + id + R"("}]}}]})");
    ASSERT_EQ(study.cells[0].scenario.effects.size(), 1);
    EXPECT_EQ(study.cells[0].scenario.effects[0].id(), id);
  }
  for (const auto& id : motion_types().ids()) {
    if (id == "recorded") continue;  // needs a recording
    const auto study =
        study_of(R"({"cells": [{"scenario": {"motion": {"profile": ")" + id + R"("}}}]})");
    EXPECT_EQ(study.cells[0].scenario.motion.id(), id);
    const auto other =
        study_of(R"({"cells": [{"scenario": {"cross_motion_2": {"profile": ")" + id + R"("}}}]})");
    EXPECT_EQ(other.cells[0].scenario.cross_motion_2.value().id(), id);
    EXPECT_FALSE(other.cells[0].scenario.cross_motion_1);
  }
  for (const auto& id : acceleration_types().ids()) {
    if (id == "recorded") continue;
    const auto study =
        study_of(R"({"cells": [{"scenario": {"acceleration": {"profile": ")" + id + R"("}}}]})");
    EXPECT_EQ(study.cells[0].scenario.acceleration.value().id(), id);
  }
}

// ---------------------------------------------------------------- from_recording

constexpr const char* source_study = R"({"seed": 11, "cells": [
    {"name": "still", "scenario": {"duration_s": 400, "rate_hz": 50,
     "random_error": {"phi": 0.8, "delta1_dps": 0.01, "delta2_dps": 0.004,
                      "measurement_noise_std_dps": 0.02},
     "temperature": {"profile": "quiet_room", "start_C": 25, "end_C": 25}}},
    {"name": "warming", "scenario": {"duration_s": 1200, "rate_hz": 10,
     "random_error": {"phi": 0.5, "delta1_dps": 0.0005, "delta2_dps": 0.0002,
                      "measurement_noise_std_dps": 0.02},
     "thermal_drift": {"a_dps_per_C": 0.004, "b_dps_s_per_C": 0.3, "c_dps": -0.1},
     "temperature": {"profile": "ramp_and_cooling", "ramp_s": 500}}}]})";

/// A folder in which "lab/rec.csv" is trial 0 of a cell of the source study.
struct RecordingFolder : TestFolder {
  explicit RecordingFolder(const std::string& cell) {
    write("source.json", source_study);
    std::filesystem::create_directory(path() / "lab");
    const auto ended =
        run_program(*this, {"simulate", "source.json", "--cell", cell, "--out", "lab/rec.csv"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }

  Scenario source(std::size_t cell) const {
    return read_study((path() / "source.json").string()).cells.at(cell).scenario;
  }
  Json tables(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--format", "json"});
    const auto ended = run_program(*this, arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return Json::parse(ended.out);
  }
};

/// The number under `column` in the first row of `table` that holds `parameter` in any cell.
double value_of(const Json& table, const std::string& parameter, const std::string& column) {
  std::size_t at = 0;
  while (table["columns"].at(at)["name"] != column) ++at;
  for (const auto& row : table["rows"]) {
    for (const auto& cell : row)
      if (cell == parameter) return row.at(at).get<double>();
  }
  throw std::runtime_error(parameter + " is not in the table");
}

template <class P>
void expect_within_four_standard_errors(const Json& table, const std::string& column,
                                        const P& truth) {
  for (const auto& field : P::fields()) {
    const std::string name(field.name);
    const double error = value_of(table, name, "standard error");
    EXPECT_NEAR(value_of(table, name, column), truth.*(field.member), 4 * error) << name;
  }
}

TEST(FromRecording, RecoversTheRandomErrorWithinFourStandardErrors) {
  const RecordingFolder folder("still");
  const auto fitted = folder.tables({"fit", "lab/rec.csv", "--method", "likelihood"});
  const auto truth = folder.source(0).random_error;
  expect_within_four_standard_errors(fitted[0], "value", truth);

  folder.write("lab/around.json", R"({"cells": [{"trials": 2, "filters": ["none", "kf"],
      "scenario": {"from_recording": {"file": "rec.csv"}, "duration_s": 400}}]})");
  const auto tables = folder.tables({"run", "lab/around.json"});
  for (const auto& field : Arima111<double>::fields()) {
    const std::string name(field.name);
    EXPECT_EQ(value_of(tables[0], name, "true"), value_of(fitted[0], name, "value")) << name;
    EXPECT_NEAR(value_of(tables[0], name, "fitted"), value_of(tables[0], name, "true"),
                4 * value_of(tables[0], name, "standard error"))
        << name;
  }
}

TEST(FromRecording, RecoversTheThermalDriftWithinFourStandardErrors) {
  const RecordingFolder folder("warming");
  const auto fitted = folder.tables({"fit", "lab/rec.csv", "--method", "likelihood"});
  expect_within_four_standard_errors(fitted[0], "value", folder.source(1).thermal_drift);

  folder.write("lab/around.json", R"({"cells": [{"trials": 2, "filters": ["none", "thermal_mlr"],
      "scenario": {"from_recording": {"file": "rec.csv"}, "duration_s": 1200}}]})");
  const auto tables = folder.tables({"run", "lab/around.json"});
  for (const auto& field : ThermalDrift<double>::fields()) {
    const std::string name(field.name);
    EXPECT_EQ(value_of(tables[0], name, "true"), value_of(fitted[0], name, "value")) << name;
  }
}

TEST(FromRecording, IsRelativeToTheStudyAndNotToTheCaller) {
  const RecordingFolder folder("still");
  folder.write("lab/around.json", R"({"cells": [{"filters": ["none"],
      "scenario": {"from_recording": {"file": "rec.csv"}}}]})");
  std::filesystem::create_directory(folder.path() / "elsewhere");
  for (const auto& [from, study] : {std::pair{"", "lab/around.json"},
                                    {"lab", "around.json"},
                                    {"elsewhere", "../lab/around.json"}}) {
    const auto ended = Program(folder.path() / from, {"validate", study}).wait();
    EXPECT_EQ(ended.exit_code, 0) << from << ": " << ended.err;
  }
}

TEST(FromRecording, WhatTheStudySaysItselfStandsAboveTheFit) {
  const RecordingFolder folder("warming");
  const auto study = study_of(folder, R"({"cells": [{"scenario": {"rate_hz": 20, "duration_s": 30,
      "from_recording": {"file": "lab/rec.csv", "to_s": 600}, "random_error": {"phi": 0.125},
      "thermal_drift": {"c_dps": 5}}}]})");
  const auto& scenario = study.cells[0].scenario;
  EXPECT_EQ(scenario.sampling.rate_hz, 20);
  EXPECT_EQ(scenario.random_error.phi, 0.125);
  EXPECT_NEAR(scenario.random_error.measurement_noise_std_dps, 0.02, 0.002);
  EXPECT_EQ(scenario.thermal_drift.c_dps, 5);
  EXPECT_NE(scenario.thermal_drift.a_dps_per_C, 0);
}

TEST(FromRecording, PlaysTheRecordedTemperatureBack) {
  const RecordingFolder folder("warming");
  folder.write("around.json", R"({"cells": [{"filters": ["none"],
      "scenario": {"from_recording": {"file": "lab/rec.csv"}, "duration_s": 1200}}]})");
  EXPECT_EQ(run_program(folder, {"simulate", "around.json", "--out", "again.csv"}).exit_code, 0);
  const auto recorded = read_recording(folder.path() / "lab/rec.csv").series;
  const auto again = read_recording(folder.path() / "again.csv").series;
  ASSERT_EQ(again.size(), recorded.size());
  for (std::size_t i = 0; i < again.size(); ++i)
    ASSERT_NEAR(again.temperature_C[i], recorded.temperature_C[i], 1e-6) << again.t_s[i];
}

/// A logger's steps, of which a derivative between samples would make spikes of 3 dps.
TEST(FromRecording, StepsOfTheTemperatureMakeNoSpikesOfTheDrift) {
  TestFolder folder;
  std::string text = "t_s,gyro_dps,temperature_C\n";
  for (int i = 0; i < 24000; ++i) {
    const double t = 0.05 * i, slope = 0.02 * std::cos(t / 150.0);
    const double temperature = 30.0 + 3.0 * std::sin(t / 150.0);
    text += fmt::format("{},{},{}\n", t, 0.3 * slope + 0.02 * std::sin(1e4 * std::sin(1e3 * i)),
                        0.5 * std::round(temperature / 0.5));
  }
  folder.write("rec.csv", text);
  auto scenario = study_of(folder, R"({"cells": [{"scenario": {
      "from_recording": {"file": "rec.csv"}, "duration_s": 1200,
      "random_error": {"measurement_noise_std_dps": 0.02}}}]})")
                      .cells[0]
                      .scenario;
  ASSERT_EQ(scenario.temperature.id(), "recorded");
  scenario.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.3, .c_dps = 0.0};
  Series series;
  synthesise(scenario, {1, 0}, series);
  double most = 0.0;
  for (const double drift : series.thermal_bias_dps) most = std::max(most, std::abs(drift));
  EXPECT_NEAR(most, 0.3 * 0.5 / 10.0, 1e-4);  // one step in ten seconds
}

// --------------------------------------------------------------- conditions_from

TEST(ConditionsFrom, PlaysTheRecordedConditionsBack) {
  TestFolder folder;
  std::string text =
      "t_s,gyro_dps,rate_ref_dps,temperature_C,acc_x_mps2,acc_y_mps2,acc_z_mps2,heading_deg\n";
  for (int i = 0; i < 400; ++i)
    text += fmt::format("{},{},{},{},{},{},{},0\n", 100 + 0.05 * i, 0.01 * (i % 7), i % 40 - 20,
                        i == 7 ? "" : fmt::format("{}", 25 + 0.01 * i), 0.1 * (i % 3), 0.2, 9.8);
  folder.write("rec.csv", text);
  folder.write("under.json", R"({"cells": [{"filters": ["none"], "scenario": {
      "conditions_from": {"file": "rec.csv", "from_s": 5, "to_s": 15},
      "effects": [{"effect": "scale_factor", "error": 0.01}]}}]})");
  ASSERT_EQ(run_program(folder, {"simulate", "under.json", "--out", "again.csv"}).exit_code, 0);
  const auto recorded = read_recording(folder.path() / "rec.csv").series;
  const auto again = read_recording(folder.path() / "again.csv").series;
  ASSERT_EQ(again.size(), 200);
  EXPECT_NEAR(again.rate_hz(), 20.0, 1e-9);
  for (std::size_t i = 0; i < again.size(); ++i) {
    ASSERT_NEAR(again.rate_ref_dps[i], recorded.rate_ref_dps[100 + i], 1e-6);
    ASSERT_NEAR(again.temperature_C[i], recorded.temperature_C[100 + i], 1e-6);
    ASSERT_NEAR(again.acc_x_mps2[i], recorded.acc_x_mps2[100 + i], 1e-6);
  }
}

TEST(ConditionsFrom, WhatTheStudySaysItselfStandsAboveTheRecording) {
  TestFolder folder;
  std::string text = "t_s,gyro_dps,temperature_C\n";
  for (int i = 0; i < 400; ++i) text += fmt::format("{},0.0{},31\n", 0.05 * i, i % 7);
  folder.write("rec.csv", text);
  const auto study = study_of(folder, R"({"cells": [{"scenario": {
      "conditions_from": {"file": "rec.csv"}, "duration_s": 6, "rate_hz": 10,
      "motion": {"profile": "sinusoidal"}}}]})");
  const auto& scenario = study.cells[0].scenario;
  EXPECT_EQ(scenario.sampling.samples(), 60);
  EXPECT_EQ(scenario.temperature.id(), "recorded");
  EXPECT_EQ(scenario.motion.id(), "sinusoidal");
  EXPECT_FALSE(scenario.acceleration);
}

TEST(ConditionsFrom, AProfileThatTheRecordingLacksIsToldWithItsPlace) {
  TestFolder folder;
  std::string text = "t_s,gyro_dps\n";
  for (int i = 0; i < 400; ++i) text += fmt::format("{},0.0{}\n", 0.05 * i, i % 7);
  folder.write("rec.csv", text);
  EXPECT_THAT(
      [&] {
        study_of(folder, R"({"cells": [{"scenario": {
      "conditions_from": {"file": "rec.csv"}, "motion": {"profile": "recorded"}}}]})");
      },
      testing::ThrowsMessage<InputError>(
          testing::AllOf(testing::HasSubstr("cells[0].scenario.motion"),
                         testing::HasSubstr("'recorded' needs a recording that has it"))));
}

}  // namespace
}  // namespace gyrostat::study_test
