// What a verb of seconds says while it works: nothing runs backwards, a line a phase where stderr
// is a file, one line that is drawn over where it is a terminal.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::progress_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

/// Rate noise on a grid of time, 100 Hz.
std::string noise(int samples) {
  std::string csv = "t_s,gyro_dps\n";
  for (int i = 0; i < samples; ++i)
    csv += fmt::format("{:.2f},{:.6f}\n", 0.01 * i, 0.1 * std::sin(1e4 * std::sin(i + 1.0)));
  return csv;
}

/// The shares in percent that `text` tells, by who tells them, in order: "fit: likelihood (50 %",
/// "still: 3/12 trials" or "blind-check: 3 of 12 diagnoses"; on a terminal "fit [###...] 50 %".
std::map<std::string, std::vector<double>> shares(const std::string& text) {
  static const std::regex told(
      R"(([\w-]+)(?:: [^(\r\n]*\((\d+) %|: (\d+)(?:/| of )(\d+) | \[[#.]+\] (\d+) %))");
  std::map<std::string, std::vector<double>> found;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), told); at != std::sregex_iterator();
       ++at) {
    const auto number = [&](std::size_t group) { return std::stod((*at)[group]); };
    found[(*at)[1]].push_back((*at)[2].matched   ? number(2)
                              : (*at)[5].matched ? number(5)
                                                 : 100.0 * number(3) / number(4));
  }
  return found;
}

void expect_never_backwards(const std::string& text, const std::string& who) {
  const auto found = shares(text);
  ASSERT_TRUE(found.contains(who)) << text;
  for (const auto& [name, told] : found)
    EXPECT_TRUE(std::ranges::is_sorted(told)) << name << ":\n" << text;
}

/// stderr of the verb, which is no terminal: plain lines, and none of them twice.
void expect_plain_lines(const TestFolder& folder, const Words& words, const std::string& who,
                        std::size_t least) {
  const auto ended = run_program(folder, words);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, Not(HasSubstr("\r")));
  EXPECT_THAT(ended.err, Not(HasSubstr("\x1b")));
  expect_never_backwards(ended.err, who);
  std::istringstream lines(ended.err);
  std::set<std::string> phases;
  for (std::string line; std::getline(lines, line);) {
    if (shares(line).empty()) continue;
    EXPECT_TRUE(phases.insert(line.substr(0, line.find('('))).second) << ended.err;
  }
  EXPECT_GE(phases.size(), least) << ended.err;
}

TEST(Progress, TheTestSeesWhatRunsBackwards) {
  EXPECT_EQ(shares("a: one (10 %)\na: two (5 %)\n").at("a"), (std::vector{10.0, 5.0}));
  EXPECT_EQ(shares("\ra [##..] 30 %: x\x1b[K\ra [#...] 20 %: y").at("a"),
            (std::vector{30.0, 20.0}));
  EXPECT_EQ(shares("b: 3/12 trials\nc: 1 of 4 diagnoses, 2 s left").at("c"), std::vector{25.0});
}

TEST(Progress, OfAFit) {
  const TestFolder folder;
  folder.write("rec.csv", noise(60'000));
  expect_plain_lines(folder, {"fit", "rec.csv"}, "fit", 2);
}

TEST(Progress, OfAReport) {
  const TestFolder folder;
  folder.write("s.json", R"({"cells": [{"name": "a", "trials": 20, "filters": ["none", "kf"],
      "scenario": {"duration_s": 10, "rate_hz": 50}}]})");
  expect_plain_lines(folder, {"run", "s.json", "--out", "r"}, "a", 1);
  expect_plain_lines(folder, {"report", "r"}, "report", 2);
}

TEST(Progress, OfADiagnosis) {
  const TestFolder folder;
  folder.write("rec.csv", noise(8'000));
  expect_plain_lines(folder, {"diagnose", "rec.csv"}, "diagnose", 2);
}

TEST(Progress, OfABlindCheck) {
  const TestFolder folder;
  folder.write("check.json", R"({"seed": 3, "recordings": 1, "none_recordings": 1,
      "durations_s": [60], "left_out": 0, "scenarios": {"still": {"rate_hz": 50}},
      "cases": [{"effect": "vibration", "scenario": "still", "strong": {"std_dps": 0.1}}]})");
  expect_plain_lines(folder, {"blind-check", "check.json", "--out", "b"}, "blind-check", 1);
}

TEST(Progress, OfAPage) {
  const TestFolder folder;
  const auto page = places::source() + "/results/published/reuse_of_m";
  const auto ended = run_program(folder, {"publish", page, "--out", "page", "--trials", "2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, Not(HasSubstr("\r")));
  const auto told = shares(ended.err);
  EXPECT_FALSE(told.empty()) << ended.err;
}

// script (util-linux) gives a terminal.
TEST(Progress, OnATerminalIsOneLineThatOnlyGrows) {
  if (std::system("command -v script >/dev/null") != 0)
    GTEST_SKIP() << "needs script of util-linux";
  const TestFolder folder;
  folder.write("rec.csv", noise(60'000));
  const auto command = fmt::format("cd '{}' && script -qec '{} fit rec.csv' /dev/null </dev/null",
                                   folder.path().string(), places::program());
  std::string said;
  FILE* pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::array<char, 4096> part{};
  while (const auto read = fread(part.data(), 1, part.size(), pipe)) said.append(part.data(), read);
  EXPECT_EQ(pclose(pipe), 0);
  EXPECT_THAT(said, HasSubstr("\rfit ["));
  expect_never_backwards(said, "fit");
}

TEST(Allan, ToEndsTheSpan) {
  const TestFolder folder;
  folder.write("rec.csv", noise(4'000));
  folder.write("head.csv", noise(1'000));  // all before 10 s
  const auto whole = run_program(folder, {"allan", "rec.csv", "--format", "json"});
  const auto span = run_program(folder, {"allan", "rec.csv", "--to", "10", "--format", "json"});
  const auto head = run_program(folder, {"allan", "head.csv", "--to", "100", "--format", "json"});
  ASSERT_EQ(span.exit_code, 0) << span.err;
  EXPECT_NE(span.out, whole.out);
  const auto nameless = [](std::string text, const std::string& name) {
    for (auto at = text.find(name); at != text.npos; at = text.find(name))
      text.erase(at, name.size());
    return text;
  };
  EXPECT_EQ(nameless(span.out, "rec.csv"), nameless(head.out, "head.csv"));
}

}  // namespace
}  // namespace gyrostat::progress_test
