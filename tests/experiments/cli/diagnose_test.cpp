// gyrostat diagnose and blind-check as a user meets them: how they go on, and how they are ended.

#include <chrono>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Clock = std::chrono::steady_clock;

/// A recording with vibration on a grid.
void record(const TestFolder& folder, double duration_s) {
  folder.write("one.json", fmt::format(R"({{"seed": 5, "cells": [{{"name": "one", "trials": 1,
      "scenario": {{"duration_s": {}, "rate_hz": 50, "temperature": {{"profile": "quiet_room"}},
        "random_error": {{"phi": 0, "delta1_dps": 1e-4, "delta2_dps": 0}},
        "effects": [{{"effect": "vibration", "std_dps": 0.1, "centre_hz": 15, "bandwidth_hz": 1}},
                    {{"effect": "quantization", "lsb_dps": 0.02}}]}},
      "filters": ["none"]}}]}})",
                                       duration_s));
  ASSERT_EQ(run_program(folder, {"simulate", "one.json", "--out", "all.csv"}).exit_code, 0);
  std::istringstream all(folder.read("all.csv"));
  std::string rec, line;
  while (std::getline(all, line))
    rec += line.substr(0, line.find(',', line.find(',') + 1)) + '\n';  // t_s, gyro_dps
  folder.write("rec.csv", rec);
}

// The aim is a second; a machine that is busy with other tests is given some more.
constexpr auto a_moment = std::chrono::seconds(5);

std::set<std::string> names_of(const std::map<std::string, std::string>& contents) {
  std::set<std::string> names;
  for (const auto& [name, unused] : contents) names.insert(name);
  return names;
}

void expect_ended_by_interrupt(Program& program, const TestFolder& folder,
                               const std::map<std::string, std::string>& before) {
  const auto asked = Clock::now();
  program.send(SIGINT);
  const auto ended = program.wait();
  EXPECT_LT(Clock::now() - asked, a_moment);
  EXPECT_EQ(ended.exit_code, 4) << ended.err;
  EXPECT_THAT(ended.out, IsEmpty());
  EXPECT_THAT(ended.err, HasSubstr("stopped early: nothing was written"));
  // Not printed: where two long files differ, that takes all memory.
  EXPECT_EQ(names_of(folder.contents()), names_of(before));
  EXPECT_TRUE(folder.contents() == before);
}

TEST(Diagnose, CtrlCEndsItInAMomentAndLeavesNothing) {
  const TestFolder folder;
  record(folder, 3600);
  const auto before = folder.contents();
  for (const int after_ms : {0, 300, 1500}) {
    Program program(folder.path(), {"diagnose", "rec.csv", "--json", "out.json", "--html",
                                    "out.html", "--scenario", "s.json", "--out-figures", "f"});
    ASSERT_TRUE(program.says("diagnose: looking for effects"));
    std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
    SCOPED_TRACE(after_ms);
    expect_ended_by_interrupt(program, folder, before);
  }
}

TEST(Diagnose, TellsOneLineAPhaseWhereNobodyWatchesAndTheAnswerFirst) {
  const TestFolder folder;
  record(folder, 200);
  const auto ended =
      run_program(folder, {"diagnose", "rec.csv", "--html", "page.html", "--scenario", "s.json",
                           "--json", "out.json", "--out-figures", "figures"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, Not(HasSubstr("\r")));
  std::istringstream lines(ended.err);
  std::set<std::string> phases;
  double last = 0.0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(line, parts, std::regex(R"(diagnose: ([a-z ]+) \((\d+) %.*\))")))
        << line;
    EXPECT_TRUE(phases.insert(parts[1]).second) << line;
    EXPECT_GE(std::stod(parts[2]), last) << line;
    last = std::stod(parts[2]);
  }
  EXPECT_GE(phases.size(), 3);

  EXPECT_TRUE(
      ended.out.starts_with("rec.csv: To make recordings like this one, the simulator lacks"))
      << ended.out;
  EXPECT_THAT(ended.out.substr(0, ended.out.find("\n\n")), Not(HasSubstr("spreads")));
  std::istringstream answer(ended.out.substr(0, ended.out.find("causes\n")));
  const auto columns = [](const std::string& line) {  // bytes that begin a character
    return std::count_if(line.begin(), line.end(),
                         [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  };
  for (std::string line; std::getline(answer, line);) EXPECT_LE(columns(line), 80) << line;
  EXPECT_THAT(folder.read("page.html"), HasSubstr("<h1>rec.csv</h1>"));
  EXPECT_THAT(folder.read("page.html"), Not(HasSubstr(folder.path().string())));
  const auto figures = folder.contents();
  for (const char* name : {"steps", "recording", "residual", "allan", "spectrum"})
    EXPECT_THAT(figures.at(fmt::format("figures/{}.svg", name)), HasSubstr("</svg>")) << name;

  const auto found = Json::parse(folder.read("out.json"));
  for (const auto& row : found.at("transfer"))
    EXPECT_THAT((std::set<std::string>{"closer", "nowhere", "away"}),
                testing::Contains(row.at("moved").get<std::string>()));
  EXPECT_THAT(Json::parse(folder.read("s.json")).at("title").get<std::string>(),
              HasSubstr(fmt::format("rec.csv: a simulator that comes {:.0f} % closer",
                                    100.0 * found.at("gap").at("closed").get<double>())));
}

TEST(Diagnose, AFailingRuleHasAStatusOfItsOwnAndALineOfJson) {
  const TestFolder folder;
  record(folder, 100);
  folder.write("none.csv", "t_s,gyro_dps\n0,1\n");
  const auto ended = run_program(folder, {"diagnose", "none.csv", "rec.csv", "--jsonl", "--fail-if",
                                          "gap>1e6", "--fail-if", "vibration>0.5"});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;  // one of them cannot be read
  std::istringstream lines(ended.out);
  std::string first, second, more;
  ASSERT_TRUE(std::getline(lines, first) && std::getline(lines, second));
  EXPECT_FALSE(std::getline(lines, more));
  EXPECT_THAT(Json::parse(first).at("error").get<std::string>(), HasSubstr("none.csv"));
  EXPECT_EQ(Json::parse(second).at("file"), "rec.csv");
  EXPECT_EQ(Json::parse(second).at("failed"), Json::array({"vibration>0.5"}));

  // Its own simulator makes such recordings; one without the vibration does not.
  record(folder, 100);
  const auto own =
      run_program(folder, {"diagnose", "rec.csv", "--baseline", "one.json", "--jsonl"});
  EXPECT_EQ(own.exit_code, 0) << own.out << own.err;
  auto bare = Json::parse(folder.read("one.json"));
  bare["cells"][0]["scenario"]["effects"] = Json::array();
  folder.write("bare.json", bare.dump());
  const auto changed = run_program(folder, {"diagnose", "rec.csv", "--baseline", "bare.json"});
  EXPECT_EQ(changed.exit_code, 5) << changed.out << changed.err;
  EXPECT_THAT(changed.err, HasSubstr("rec.csv: p<0.02 holds: p is "));
}

TEST(Diagnose, TakesEveryAxisUnlessOneIsChosen) {
  const TestFolder folder;
  folder.write("two.csv", "t_s,gyro_x_dps,gyro_z_dps\n0,1,2\n0.1,3,4\n");  // too short for each
  const auto axes_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"diagnose", "two.csv", "--jsonl"});
    std::istringstream lines(run_program(folder, arguments).out);
    std::string axes;
    for (std::string line; std::getline(lines, line);)
      axes += Json::parse(line).value("axis", "none");
    return axes;
  };
  EXPECT_EQ(axes_of({}), "xz");
  EXPECT_EQ(axes_of({"--axis", "all"}), "xz");
  EXPECT_EQ(axes_of({"--axis", "z"}), "z");
  const auto claim = run_program(folder, {"diagnose", "two.csv", "--claim", "study.json"});
  EXPECT_EQ(claim.exit_code, 2);
  EXPECT_THAT(claim.err, HasSubstr("one recording and axis, which --axis chooses"));
}

TEST(Diagnose, WritesAPageAndAStudyOfEachAxis) {
  const TestFolder folder;
  std::string csv = "t_s,gyro_x_dps,gyro_z_dps,temperature_C\n";
  for (int i = 0; i < 1200; ++i)
    csv += fmt::format("{:.2f},{},{},{}\n", 0.05 * i, 0.05 * std::sin(1e4 * std::sin(1e3 * i)),
                       0.05 * std::sin(1e4 * std::cos(1e3 * i)), 20 + 0.01 * i);
  folder.write("two.csv", csv);
  const auto ran = run_program(folder, {"diagnose", "two.csv", "--html", "page.html", "--scenario",
                                        "study.json", "--out-figures", "figures"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto page = folder.read("page.html");
  for (const std::string axis : {"x", "z"}) {
    EXPECT_THAT(page, HasSubstr("<a href=\"page_" + axis + ".html\">" + axis + "</a>"));
    EXPECT_THAT(folder.read("page_" + axis + ".html"), HasSubstr("two.csv, axis " + axis));
    EXPECT_THAT(folder.read("figures/allan_" + axis + ".svg"), HasSubstr("<svg"));
    const auto study = Json::parse(folder.read("study_" + axis + ".json"));
    const auto& conditions = study["cells"][0]["scenario"]["conditions_from"];
    EXPECT_EQ(conditions, Json({{"file", "two.csv"}, {"axis", axis}}));
    EXPECT_EQ(run_program(folder, {"validate", "study_" + axis + ".json"}).exit_code, 0);
  }
}

/// Means of three neighbours, which no filter makes, of noise of two sizes.
TEST(Diagnose, FitsOnceWhatAllAxesHaveAlike) {
  constexpr std::size_t samples = 1500;
  std::vector<double> x(samples + 2), z(samples + 2);
  NormalStream(1, 0, "diagnose_test x").fill(0, x);
  NormalStream(1, 0, "diagnose_test z").fill(0, z);
  std::string csv = "t_s,gyro_x_dps,gyro_z_dps\n";
  for (std::size_t i = 0; i < samples; ++i)
    csv += fmt::format("{:.2f},{},{}\n", 0.05 * static_cast<double>(i),
                       0.05 * (x[i] + x[i + 1] + x[i + 2]), 0.08 * (z[i] + z[i + 1] + z[i + 2]));
  const TestFolder folder;
  folder.write("two.csv", csv);
  const auto ran = run_program(folder, {"diagnose", "two.csv", "--json", "found.json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto found = Json::parse(folder.read("found.json"));
  ASSERT_EQ(found["shared"].size(), 1) << found["shared"];
  const auto& shared = found["shared"][0];
  EXPECT_EQ(shared["in"], Json({"x", "z"}));
  EXPECT_EQ(shared["fitted_once"], true);
  const auto& length = shared["parameters"]["length"];
  EXPECT_EQ(length["spread"], 0.0);
  EXPECT_GT(length["p_equal"], 0.0);
  EXPECT_LT(length["mean_interval"][0], length["mean"]);
  for (const auto& each : found["each"]) {
    const auto& effect = each["diagnosis"]["effects"][0];
    EXPECT_EQ(effect["of_all_axes"], true);
    EXPECT_EQ(effect["parameters"]["length"], length["mean"]);
  }
  EXPECT_THAT(ran.out, HasSubstr("Fitted once for all axes: " + std::string(shared["effect"])));
  const auto lines = run_program(folder, {"diagnose", "two.csv", "--jsonl"}).out;
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2);
  EXPECT_THAT(lines, HasSubstr(std::string(shared["effect"])));
}

TEST(Diagnose, AColumnOfTheGyroIsChosenAndOthersAreOfTheMotion) {
  const TestFolder folder;
  folder.write("turned.csv",
               "t_s,gyro_dps,gyro_x_dps,rate_ref_dps\n0,0,1,0\n0.1,90,2,90\n");  // too short
  const auto lines = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"diagnose", "turned.csv", "--jsonl"});
    return run_program(folder, arguments).out;
  };
  EXPECT_THAT(lines({}), AllOf(HasSubstr("turned.csv"), Not(HasSubstr("axis"))));
  EXPECT_THAT(lines({"--axis", "x"}), HasSubstr("does not turn with rate_ref_dps"));
  const auto all = run_program(folder, {"diagnose", "turned.csv", "--axis", "all", "--jsonl"});
  EXPECT_THAT(all.err, HasSubstr("axis x does not turn with rate_ref_dps"));
  EXPECT_THAT(all.out, Not(HasSubstr("does not turn")));
}

TEST(Diagnose, OfBurstsOneIsTakenByItsSpan) {
  const TestFolder folder;
  std::string csv = "t_s,gyro_dps\n";
  for (int burst = 0; burst < 2; ++burst)
    for (int i = 0; i < 1100; ++i)
      csv += fmt::format("{:.2f},{}\n", 1000.0 * burst + 0.02 * i, (i * 7919 % 1000) * 1e-3);
  folder.write("bursts.csv", csv);
  const auto whole = run_program(folder, {"diagnose", "bursts.csv"});
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_THAT(whole.err, HasSubstr("is 2 bursts"));
  const auto one = run_program(folder, {"diagnose", "bursts.csv", "--from", "900"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
}

TEST(BlindCheck, CtrlCEndsItInAMomentAndTheSameGoesOn) {
  const TestFolder folder;
  folder.write("check.json", R"({"seed": 3, "recordings": 1, "none_recordings": 2,
      "durations_s": [3600], "left_out": 0, "scenarios": {"still": {"rate_hz": 50}},
      "cases": [{"effect": "vibration", "scenario": "still", "strong": {"std_dps": 0.1}}]})");
  Program program(folder.path(), {"blind-check", "check.json", "--out", "out"});
  const auto is_diagnosing = [&] {
    for (const auto& [name, contents] : folder.contents())
      if (name.ends_with(".json.log") && contents.find("looking for effects") != std::string::npos)
        return true;
    return false;
  };
  while (!is_diagnosing()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const auto asked = Clock::now();
  program.send(SIGINT);
  const auto ended = program.wait();
  EXPECT_LT(Clock::now() - asked, a_moment);
  EXPECT_EQ(ended.exit_code, 4) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("stopped early"));
  EXPECT_THAT(ended.err, Not(HasSubstr("ended with status")));
  for (const auto& [name, contents] : folder.contents())
    if (name.starts_with("out/diagnoses/") && name.ends_with(".json")) {
      EXPECT_TRUE(Json::accept(contents)) << name;
    }
}

}  // namespace
}  // namespace gyrostat
