// The program as a user meets it: every verb on small studies, in a folder of its own.

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <regex>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/core/track.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/generators/effect.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/recordings/text.hpp>
#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::cli_test {
namespace {

using Row = std::vector<std::string>;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* small_study = R"({"title": "small", "seed": 7, "cells": [
    {"name": "still", "trials": 6, "scenario": {"duration_s": 12, "rate_hz": 50},
     "filters": ["none", "kf", "sr_rsukf", "oracle"]},
    {"name": "warming, 'up'", "trials": 4,
     "scenario": {"duration_s": 100, "rate_hz": 10,
                  "thermal_drift": {"a_dps_per_C": 0.002, "b_dps_s_per_C": 0.1, "c_dps": -0.05},
                  "temperature": {"profile": "ramp_and_cooling", "ramp_s": 50},
                  "motion": {"profile": "rate_table"}, "effects": [{"effect": "outliers"}],
                  "compass": {"disturbances": [{"start_s": 30, "duration_s": 20}]}},
     "calibration": {"each_trial": 1, "duration_s": 80},
     "filters": ["none", {"id": "fixed", "filter": "thermal_stf", "parameters": {"adaptive": 0}}]}
    ]})";

/// `arguments` in a folder with the small study; the program must end well.
Ended run_well(const TestFolder& folder, const Row& arguments) {
  folder.write("small.json", small_study);
  auto ended = run_program(folder, arguments);
  EXPECT_EQ(ended.exit_code, 0) << fmt::format("{}: ", fmt::join(arguments, " ")) << ended.err;
  return ended;
}

Row lines_of(const std::string& text) {
  Row lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The rows of a CSV as RFC 4180 has them; a comment (# ...) is a row of one cell.
std::vector<Row> csv_rows(const std::string& text) {
  std::vector<Row> rows;
  Row row = {""};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool comment = row.size() == 1 && row[0].starts_with('#');
    if (c == '\n' && !quoted) {
      rows.push_back(std::exchange(row, {""}));
    } else if (comment || (c != '"' && (c != ',' || quoted))) {
      row.back() += c;
    } else if (c == ',') {
      row.emplace_back();
    } else if (quoted && i + 1 < text.size() && text[i + 1] == '"') {
      row.back() += text[++i];
    } else {
      quoted = !quoted;
    }
  }
  return rows;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

// ---------------------------------------------------------------- simulate

TEST(Simulate, WritesWhatATrialSees) {
  const TestFolder folder;
  run_well(folder, {"simulate", "small.json", "--trial", "3", "--out", "rec.csv"});
  const auto study = read_study((folder.path() / "small.json").string());
  Series expected;
  synthesise(study.cells[0].scenario, {study.seed, 3}, expected);
  const auto recording = read_recording(folder.path() / "rec.csv");
  EXPECT_THAT(recording.ignored_columns, IsEmpty());
  for (const auto& channel : channels) {
    const auto& values = recording.series.*channel.values;
    const auto& truth = expected.*channel.values;
    ASSERT_EQ(values.size(), truth.size()) << channel.name;
    for (std::size_t i = 0; i < truth.size(); ++i)
      ASSERT_EQ(bits(values[i]), bits(truth[i])) << channel.name << '[' << i << ']';
  }
}

TEST(Simulate, GivesTheSameBytesTwiceAndOthersForAnotherTrial) {
  const TestFolder folder;
  run_well(folder, {"simulate", "small.json", "--trial", "2", "--out", "a.csv.gz"});
  run_well(folder, {"simulate", "small.json", "--trial", "2", "--out", "b.csv.gz"});
  run_well(folder, {"simulate", "small.json", "--trial", "3", "--out", "c.csv.gz"});
  EXPECT_EQ(folder.read("a.csv.gz"), folder.read("b.csv.gz"));
  EXPECT_NE(folder.read("a.csv.gz"), folder.read("c.csv.gz"));
}

TEST(Simulate, IsReadByFitApplyAndAllan) {
  const TestFolder folder;
  run_well(folder, {"simulate", "small.json", "--cell", "warming, 'up'", "--out", "rec.csv.gz"});
  EXPECT_THAT(run_well(folder, {"fit", "rec.csv.gz"}).out, HasSubstr("a_dps_per_C"));
  EXPECT_THAT(run_well(folder, {"apply", "rec.csv.gz"}).out, HasSubstr("thermal_stf"));
  EXPECT_THAT(run_well(folder, {"allan", "rec.csv.gz"}).out, HasSubstr("Allan deviation"));
}

TEST(Fit, TakesAnEvenSpanOfAnUnevenRecording) {
  const TestFolder folder;
  std::string csv = "t_s,gyro_dps\n";
  for (int i = 0; i < 1200; ++i)
    csv += fmt::format("{:.2f},{:.6f}\n", i / 100.0 + (i < 600 ? 0 : 300), 0.1 * std::sin(i * i));
  folder.write("bursts.csv", csv);
  EXPECT_EQ(run_program(folder, {"fit", "bursts.csv"}).exit_code, 2);
  run_well(folder, {"fit", "bursts.csv", "--to", "5.99"});
  run_well(folder, {"fit", "bursts.csv", "--from", "300"});
}

/// As blank cells do; an option takes one span, so that what follows is the recording.
TEST(Fit, LeavesOutWhatDoesNotCount) {
  const TestFolder folder;
  std::string whole = "t_s,gyro_dps\n", blank = whole;
  for (int i = 0; i < 2000; ++i) {
    const bool is_out = (i >= 500 && i < 530) || i < 10;
    const double rate = 0.1 * std::sin(i * i) + (is_out ? 5.0 : 0.0);
    whole += fmt::format("{:.2f},{:.6f}\n", 7.0 + i / 100.0, rate);
    blank += is_out ? fmt::format("{:.2f},\n", 7.0 + i / 100.0)
                    : fmt::format("{:.2f},{:.6f}\n", 7.0 + i / 100.0, rate);
  }
  folder.write("rec.csv", whole);
  const auto left_out =
      run_well(folder, {"fit", "--leave-out", "5:5.299", "--leave-out", "0:0.1", "rec.csv"});
  folder.write("rec.csv", blank);
  EXPECT_EQ(left_out.out, run_well(folder, {"fit", "rec.csv"}).out);
}

// ---------------------------------------------------------------- apply

constexpr const char* config = R"({"filters": [
    {"id": "mine", "filter": "kf", "parameters": {"phi": -0.25, "delta1_dps": 0.003,
     "delta2_dps": 0.001, "measurement_noise_std_dps": 0.04, "initial_x_dps": 0.1,
     "initial_x_previous_dps": 0.2, "initial_x_std_dps": 0.3, "initial_x_previous_std_dps": 0.4}},
    "none", {"filter": "sr_rsukf", "parameters": {"mu_phi": 0.5}}]})";

/// `apply` with the config over a recording whose sample 5 is missing; what it wrote.
std::vector<Row> apply_config(const TestFolder& folder) {
  std::string csv = "t_s,gyro_dps\n";
  for (int i = 0; i < 200; ++i)
    csv += i == 5 ? "0.05,\n" : fmt::format("{:.2f},{:.17g}\n", i / 100.0, 0.1 * std::sin(i * i));
  folder.write("rec.csv", csv);
  folder.write("config.json", config);
  run_well(folder, {"apply", "rec.csv", "--config", "config.json", "--out", "out.csv"});
  return csv_rows(folder.read("out.csv"));
}

TEST(Apply, WritesTheColumnsOfEveryMethodInTheOrderOfTheConfig) {
  const TestFolder folder;
  const auto rows = apply_config(folder);
  ASSERT_EQ(rows.size(), 201);
  EXPECT_THAT(rows[0], ElementsAre("t_s", "raw_dps", "mine_estimate_dps", "mine_innovation_dps",
                                   "mine_innovation_variance", "mine_status", "none_estimate_dps",
                                   "none_innovation_dps", "none_innovation_variance", "none_status",
                                   "sr_rsukf_estimate_dps", "sr_rsukf_innovation_dps",
                                   "sr_rsukf_innovation_variance", "sr_rsukf_status"));
  for (const auto& row : rows) EXPECT_EQ(row.size(), 14);
}

TEST(Apply, WritesWhatTheFilterWithTheseParametersGivesToTheLastBit) {
  const TestFolder folder;
  const auto rows = apply_config(folder);
  const auto series = read_recording(folder.path() / "rec.csv").series;
  filters::Kf<double>::Parameters p;
  p.phi = -0.25;
  p.delta1_dps = 0.003;
  p.delta2_dps = 0.001;
  p.measurement_noise_std_dps = 0.04;
  p.initial_x_dps = 0.1;
  p.initial_x_previous_dps = 0.2;
  p.initial_x_std_dps = 0.3;
  p.initial_x_previous_std_dps = 0.4;
  Track track;
  run_filter(filters::Kf<double>(p), series, track);
  const auto text = [](double v) { return std::isnan(v) ? "" : fmt::format("{:.17g}", v); };
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto& row = rows.at(i + 1);
    EXPECT_EQ(bits(std::stod(row[0])), bits(series.t_s[i]));
    EXPECT_EQ(row[1], text(series.gyro_dps[i]));
    EXPECT_EQ(row[2], text(track.estimate_dps[i]));
    EXPECT_EQ(row[3], text(track.innovation_dps[i]));
    EXPECT_EQ(row[4], text(track.innovation_variance[i]));
    EXPECT_EQ(row[5], name_of(track.status[i]));
  }
}

TEST(Apply, LeavesBlankWhatThereIsNot) {
  const TestFolder folder;
  const auto rows = apply_config(folder);
  const auto& missing = rows.at(6);
  EXPECT_THAT(missing, testing::Contains("no_measurement").Times(testing::Ge(2)));
  for (const std::size_t column : {1, 3, 11}) EXPECT_EQ(missing[column], "") << column;
  for (const std::size_t column : {2, 10}) EXPECT_NE(missing[column], "") << column;
  for (const std::size_t column : {7, 8}) EXPECT_EQ(rows.at(7)[column], "") << column;
  EXPECT_EQ(rows.at(7)[5], "ok");
}

TEST(Apply, GivesTheSameBytesTwice) {
  const TestFolder folder;
  apply_config(folder);
  const auto first = folder.read("out.csv");
  apply_config(folder);
  EXPECT_EQ(folder.read("out.csv"), first);
}

TEST(Apply, NamesTheMethodsThatTheRecordingCannotServe) {
  const TestFolder folder;
  apply_config(folder);
  const auto ended = run_well(folder, {"apply", "rec.csv", "--calibration", "0.5"});
  EXPECT_THAT(ended.err, testing::ContainsRegex("thermal_kf left out: .*temperature_C"));
  EXPECT_THAT(ended.out, Not(HasSubstr("thermal_kf")));
}

// ---------------------------------------------------------------- run

TEST(Run, GivesTheSameBytesForOneThreadAndEightAndForASecondRun) {
  const TestFolder folder;
  const auto run = [&](const char* out, const char* threads) {
    return run_well(folder,
                    {"run", "small.json", "--format", "json", "--out", out, "--threads", threads})
        .out;
  };
  const auto tables = run("one", "1");
  EXPECT_EQ(run("eight", "8"), tables);
  EXPECT_EQ(run("again", "8"), tables);
  for (const std::string name : {"outcomes.csv.gz", "tables.json", "tables.md"}) {
    EXPECT_FALSE(folder.read("one/" + name).empty()) << name;
    EXPECT_EQ(folder.read("one/" + name), folder.read("eight/" + name)) << name;
    EXPECT_EQ(folder.read("one/" + name), folder.read("again/" + name)) << name;
  }
  EXPECT_EQ(folder.read("one/tables.json"), tables);
}

TEST(Run, OutcomesAreOneRowATrialAndMethodInOrder) {
  const TestFolder folder;
  run_well(folder, {"run", "small.json"});
  const auto rows = csv_rows(read_text(folder.path() / "runs/small/outcomes.csv.gz"));
  ASSERT_EQ(rows.size(), 1 + 6 * 4 + 4 * 2);
  for (const auto& row : rows)
    ASSERT_EQ(row.size(), rows[0].size()) << fmt::format("{}", fmt::join(row, "|"));
  EXPECT_THAT(Row(rows[1].begin(), rows[1].begin() + 3), ElementsAre("still", "0", "none"));
  EXPECT_THAT(Row(rows[8].begin(), rows[8].begin() + 3), ElementsAre("still", "1", "oracle"));
  EXPECT_THAT(Row(rows[32].begin(), rows[32].begin() + 3),
              ElementsAre("warming, 'up'", "3", "fixed"));
}

TEST(Run, TheCellsOfAGridAreRowsThatCanBeRead) {
  const TestFolder folder;
  folder.write("grid.json", R"({"cells": [{"name": "g", "trials": 2, "filters": ["none"],
      "scenario": {"rate_hz": 20}, "grid": {"scenario.random_error.phi": [0.1, 0.2],
                                            "scenario.duration_s": [10, 20]}}]})");
  run_well(folder, {"run", "grid.json"});
  const auto rows = csv_rows(read_text(folder.path() / "runs/grid/outcomes.csv.gz"));
  ASSERT_EQ(rows.size(), 1 + 2 * 2 * 2);
  EXPECT_EQ(rows[3][0], "g[phi=0.1,duration_s=20]");
  for (const auto& row : rows) ASSERT_EQ(row.size(), rows[0].size());
}

TEST(Run, TrialsOfTheCommandLineStandInForTheStudys) {
  const TestFolder folder;
  run_well(folder, {"run", "small.json", "--trials", "2", "--out", "two"});
  EXPECT_EQ(csv_rows(read_text(folder.path() / "two/outcomes.csv.gz")).size(), 1 + 2 * (4 + 2));
}

TEST(Run, FewerTrialsAreTheFirstOfMore) {
  const TestFolder folder;
  run_well(folder, {"run", "small.json", "--trials", "2", "--out", "two"});
  run_well(folder, {"run", "small.json", "--trials", "5", "--out", "five"});
  const auto more = lines_of(read_text(folder.path() / "five/outcomes.csv.gz"));
  for (const auto& line : lines_of(read_text(folder.path() / "two/outcomes.csv.gz")))
    EXPECT_THAT(more, testing::Contains(line));
}

TEST(Run, ProgressIsPlainLinesWhereNobodyWatches) {
  const TestFolder folder;
  const auto ended = run_well(folder, {"run", "small.json", "--trials", "40"});
  EXPECT_THAT(ended.err, Not(HasSubstr("\r")));
  EXPECT_THAT(ended.err, Not(HasSubstr("\x1b")));
  const auto lines = lines_of(ended.err);
  ASSERT_GE(lines.size(), 3);
  EXPECT_LE(lines.size(), 2 * 10 + 1);
  EXPECT_THAT(lines.front(), testing::MatchesRegex("still: [0-9]+/40 trials, [0-9]+ trials/s.*"));
  EXPECT_THAT(lines.back(), HasSubstr("results: runs/small"));
}

/// Sends `signal` to a run of far more trials than there is time for, once some are done.
void expect_orderly_end(int signal) {
  const TestFolder folder;
  folder.write("long.json", R"({"cells": [
      {"name": "long", "trials": 4000, "scenario": {"duration_s": 400, "rate_hz": 50},
       "filters": ["none"]}, {"name": "never"}]})");
  Program program(folder.path(), {"run", "long.json", "--format", "json"});
  ASSERT_TRUE(program.says("long: "));
  program.send(signal);
  const auto ended = program.wait();
  EXPECT_EQ(ended.exit_code, 4);
  EXPECT_THAT(ended.err, HasSubstr("stopped early"));
  const auto tables = Json::parse(ended.out);
  const auto rows = csv_rows(read_text(folder.path() / "runs/long/outcomes.csv.gz"));
  EXPECT_GT(rows.size(), 1);
  EXPECT_LT(rows.size(), 4000);
  EXPECT_THAT(ended.out, HasSubstr(fmt::format("over {} of 4000 trials", rows.size() - 1)));
  EXPECT_EQ(folder.read("runs/long/tables.json"), ended.out);
  EXPECT_THAT(ended.out, Not(HasSubstr("never")));
}

TEST(Run, CtrlCEndsWithTheTablesOfWhatIsDone) { expect_orderly_end(SIGINT); }

TEST(Run, ATerminationEndsAsCtrlCDoes) { expect_orderly_end(SIGTERM); }

TEST(Run, ABadInputLeavesTheEarlierResults) {
  const TestFolder folder;
  run_well(folder, {"run", "small.json"});
  const auto before = folder.contents();
  folder.write("small.json", "{}");
  EXPECT_EQ(run_program(folder, {"run", "small.json"}).exit_code, 2);
  auto after = folder.contents();
  after["small.json"] = before.at("small.json");
  EXPECT_EQ(after, before);
}

// ---------------------------------------------------------------- formats

std::string tables_as(const std::string& format) {
  const TestFolder folder;
  return run_well(folder, {"run", "small.json", "--format", format}).out;
}

TEST(Format, JsonIsParsedAndEveryRowHasItsColumns) {
  const auto tables = Json::parse(tables_as("json"));
  ASSERT_GE(tables.size(), 2);
  for (const auto& table : tables) {
    EXPECT_FALSE(table.at("title").get<std::string>().empty());
    EXPECT_FALSE(table.at("rows").empty());
    for (const auto& row : table.at("rows")) EXPECT_EQ(row.size(), table.at("columns").size());
  }
}

TEST(Format, CsvHasAsManyCellsInEveryRowOfATable) {
  std::size_t tables = 0, columns = 0;
  for (const auto& row : csv_rows(tables_as("csv"))) {
    if (row[0].starts_with("# note: ")) continue;
    if (row[0].starts_with("#")) {
      columns = 0;
    } else if (row != Row{""}) {
      tables += columns == 0;
      if (columns == 0) columns = row.size();
      EXPECT_EQ(row.size(), columns) << fmt::format("{}", fmt::join(row, "|"));
    }
  }
  EXPECT_EQ(tables, Json::parse(tables_as("json")).size());
}

TEST(Format, CsvNumbersAreThoseOfJson) {
  const auto json = Json::parse(tables_as("json"));
  const auto rows = csv_rows(tables_as("csv"));
  const auto& expected = json[0]["rows"][0];
  ASSERT_GT(rows.size(), 3);
  for (std::size_t c = 0; c < expected.size(); ++c) {
    if (!expected[c].is_number()) continue;
    EXPECT_EQ(bits(std::stod(rows[2][c])), bits(expected[c].get<double>()));
  }
}

TEST(Format, MarkdownHasAsManyBarsInEveryRowOfATable) {
  const std::regex escaped(R"(\\.)");
  std::size_t tables = 0;
  std::ptrdiff_t bars = 0;
  for (const auto& line : lines_of(tables_as("md"))) {
    const auto bare = std::regex_replace(line, escaped, "");
    if (!bare.starts_with("|")) {
      bars = 0;
      continue;
    }
    tables += bars == 0;
    if (bars == 0) bars = std::ranges::count(bare, '|');
    EXPECT_EQ(std::ranges::count(bare, '|'), bars) << line;
  }
  EXPECT_EQ(tables, Json::parse(tables_as("json")).size());
}

TEST(Format, LatexIsBalancedAndEveryRowHasItsColumns) {
  const auto latex = tables_as("latex");
  std::size_t columns = 0;
  int depth = 0, environments = 0;
  for (const auto& line : lines_of(latex)) {
    environments += line.starts_with("\\begin{") - line.starts_with("\\end{");
    const auto bare = std::regex_replace(line, std::regex(R"(\\[&%_#$\{\}])"), "");
    for (const char c : bare) {
      depth += (c == '{') - (c == '}');
      EXPECT_GE(depth, 0) << line;
    }
    const std::string spec = "\\begin{tabular}{";
    if (line.starts_with(spec)) columns = line.size() - spec.size() - 1;
    if (!line.ends_with("\\\\")) continue;
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(bare, '&')), columns - 1) << line;
  }
  EXPECT_EQ(depth, 0);
  EXPECT_EQ(environments, 0);
  EXPECT_GT(columns, 0);
}

TEST(Format, FitApplyAndAllanHaveAllFive) {
  const TestFolder folder;
  run_well(folder, {"simulate", "small.json", "--out", "rec.csv"});
  for (const char* verb : {"fit", "apply", "allan"}) {
    for (const char* format : {"text", "md", "csv", "latex"})
      EXPECT_FALSE(run_well(folder, {verb, "rec.csv", "--format", format}).out.empty());
    EXPECT_TRUE(
        Json::parse(run_well(folder, {verb, "rec.csv", "--format", "json"}).out).is_array());
  }
}

// ---------------------------------------------------------------- list, validate, help

TEST(List, FiltersNameEveryParameterWithDefaultUnitRangeAndMeaning) {
  const TestFolder folder;
  const auto listed = Json::parse(run_well(folder, {"list", "filters", "--json"}).out);
  ASSERT_EQ(listed.size(), filter_types().ids().size());
  std::size_t f = 0;
  for (const auto& type : filter_types()) {
    const Json& filter = listed[f++];
    EXPECT_EQ(filter.at("id"), type.id);
    EXPECT_FALSE(filter.at("title").get<std::string>().empty());
    const auto& parameters = filter.at("parameters");
    ASSERT_EQ(parameters.size(), type.fields.size()) << type.id;
    std::size_t i = 0;
    for (const auto& field : type.fields) {
      const Json& parameter = parameters[i++];
      EXPECT_EQ(parameter.at("name"), field.name);
      EXPECT_EQ(parameter.at("default").get<double>(), field.value);
      EXPECT_TRUE(field.range.contains(parameter.at("default").get<double>())) << field.name;
      for (const char* key : {"unit", "range", "meaning"})
        EXPECT_FALSE(parameter.at(key).get<std::string>().empty()) << field.name << ' ' << key;
    }
  }
}

TEST(List, EveryDefaultCanBeWrittenIntoAConfig) {
  const TestFolder folder;
  apply_config(folder);
  Json full = {{"filters", Json::array()}};
  for (const auto& filter : Json::parse(run_well(folder, {"list", "filters", "--json"}).out)) {
    auto parameters = Json::object();
    for (const auto& p : filter["parameters"]) parameters[p["name"]] = p["default"];
    full["filters"].push_back({{"filter", filter["id"]}, {"parameters", parameters}});
  }
  Json bare = {{"filters", filter_types().ids()}};
  folder.write("full.json", full.dump());
  folder.write("bare.json", bare.dump());
  run_well(folder, {"apply", "rec.csv", "--config", "full.json", "--out", "full.csv"});
  run_well(folder, {"apply", "rec.csv", "--config", "bare.json", "--out", "bare.csv"});
  EXPECT_EQ(folder.read("full.csv"), folder.read("bare.csv"));
}

/// What a terminal shows: UTF-8 continuation bytes are not.
auto characters(const std::string& line) {
  return std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

TEST(List, WithoutArgumentsNamesEveryKindAndPlugin) {
  const TestFolder folder;
  const auto out = run_well(folder, {"list"}).out;
  for (const char* kind :
       {"filters", "effects", "temperatures", "motions", "accelerations", "metrics", "studies"})
    EXPECT_THAT(lines_of(out), testing::Contains(kind));
  for (const auto& ids : {filter_types().ids(), effect_types().ids(), metric_types().ids()}) {
    for (const auto& id : ids) EXPECT_THAT(out, HasSubstr("  " + id + " "));
  }
  for (const auto& line : lines_of(out)) EXPECT_LE(characters(line), 80) << line;
}

TEST(List, EveryKindIsJsonOnRequest) {
  const TestFolder folder;
  for (const char* kind :
       {"effects", "temperatures", "motions", "accelerations", "metrics", "studies"})
    EXPECT_TRUE(Json::parse(run_well(folder, {"list", kind, "--json"}).out).is_array()) << kind;
}

TEST(List, StudiesAreThoseOfTheFolder) {
  const TestFolder folder;
  folder.write("studies/mine.json", small_study);
  const auto out = run_well(folder, {"list", "studies", "--studies", "studies"}).out;
  EXPECT_THAT(out, HasSubstr("studies/mine.json"));
  EXPECT_THAT(out, HasSubstr("small"));
}

TEST(Validate, NamesTheCellsWithTrialsSamplesAndMethods) {
  const TestFolder folder;
  const auto out = run_well(folder, {"validate", "small.json"}).out;
  EXPECT_THAT(out, HasSubstr("still: 6 trials of 600 samples"));
  EXPECT_THAT(out, HasSubstr("none, kf, sr_rsukf, oracle"));
  EXPECT_THAT(out, HasSubstr("warming, 'up': 4 trials of 1000 samples"));
  EXPECT_THAT(out, HasSubstr("none, fixed"));
}

TEST(Help, NamesEveryVerbAndEveryVerbHasItsOwn) {
  const TestFolder folder;
  const auto help = run_well(folder, {"--help"}).out;
  for (const std::string verb :
       {"run", "plan", "sensitivity", "status", "export", "replay", "merge", "slurm", "fit",
        "apply", "simulate", "allan", "list", "validate"}) {
    EXPECT_THAT(help, HasSubstr("  " + verb + " "));
    EXPECT_THAT(run_well(folder, {verb, "--help"}).out, HasSubstr("gyrostat " + verb));
  }
}

TEST(Readme, ItsExamplesAreAccepted) {
  const TestFolder folder;
  apply_config(folder);
  std::ifstream file(places::source() + "/README.md");
  const std::string readme((std::istreambuf_iterator<char>(file)), {});
  int examples = 0;
  for (std::size_t at = 0; (at = readme.find("```json\n", at)) != std::string::npos; ++examples) {
    at += 8;
    const auto json = readme.substr(at, readme.find("```", at) - at);
    folder.write("example.json", json);
    if (Json::parse(json).contains("cells"))
      run_well(folder, {"validate", "example.json"});
    else
      run_well(folder, {"apply", "rec.csv", "--config", "example.json"});
  }
  EXPECT_GT(examples, 0);
}

TEST(Output, ThatCannotBeWrittenIsAnError) {
  const auto command = places::program() + " list > /dev/full 2> /dev/null";
  EXPECT_NE(std::system(command.c_str()), 0);
}

// ---------------------------------------------------------------- memory

#ifndef __SANITIZE_ADDRESS__
TEST(Memory, TenThousandTrialsOfAMinuteStayUnder300MiB) {
  const TestFolder folder;
  folder.write("many.json", R"({"cells": [{"trials": 10000, "filters": ["none", "kf"],
      "scenario": {"duration_s": 60, "rate_hz": 100}}]})");
  const auto many = run_program(folder, {"run", "many.json"});
  EXPECT_EQ(many.exit_code, 0) << many.err;
  EXPECT_LT(many.peak_KiB, 300 * 1024);
}

// Beyond the first hundred thousand a trial takes disk, and one bit of memory.
TEST(Memory, DoesNotGrowWithTheNumberOfTrials) {
  const TestFolder folder;
  folder.write(
      "many.json",
      R"({"cells": [{"filters": ["none"], "scenario": {"duration_s": 1, "rate_hz": 20}}]})");
  const auto peak_KiB = [&](const char* trials) {
    const auto ended =
        run_program(folder, {"run", "many.json", "--trials", trials, "--out", trials});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended.peak_KiB;
  };
  EXPECT_LT(peak_KiB("300000") - peak_KiB("100000"), 4 * 1024);
}
#endif

}  // namespace
}  // namespace gyrostat::cli_test
