// Every verb, ended by SIGINT or SIGTERM at several moments: within a second, with the status that
// says whether it can be resumed, and no file half-written.

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::signals_test {
namespace {

using Words = std::vector<std::string>;
using Clock = std::chrono::steady_clock;
constexpr bool in_order = true;

struct Call {
  Words words;
  bool ends_in_order = false;
};

const std::string source = places::source();

/// One call or more of every verb; the longer ones are still at it at the last moment below.
std::vector<Call> calls() {
  const auto studies = source + "/experiments/studies/";
  return {{{"run", "long.json"}, in_order},
          {{"run", "tuned.json"}, in_order},
          {{"plan", "long.json", "--pilot", "100"}},
          {{"sensitivity", "runs/small"}},
          {{"status", "runs/small"}},
          {{"export", "runs/small", "--out", "outcomes.csv.gz"}},
          {{"report", "runs/small", "--replay", "5000"}},
          {{"replay", "long:long:0:kf", "--study", "long.json"}},
          {{"rank", "runs/small", "--figures", "."}},
          {{"consistency", "runs/small"}},
          {{"failure", "runs/rare", "--how"}},
          {{"check-plugin", places::plugins() + "/sound.so"}},
          {{"merge", "merged", "runs/small"}},
          {{"repair", "runs/small"}},
          {{"slurm", "long.json"}},
          {{"fit", "rec.csv"}},
          {{"apply", "rec.csv", "--out", "applied.csv"}},
          {{"simulate", "long.json", "--out", "simulated.csv"}},
          {{"allan", "rec.csv"}},
          {{"export-model", "rec.csv", "--for", "all", "--out", "models"}},
          {{"tune", "tuned.json", "--out", "tuned_out.json", "--json", "tuning.json"}, in_order},
          {{"match", "match.json", "--study", "matched.json"}},
          {{"ledger", "ledger.json"}},
          {{"coverage", studies + "coverage.json"}},
          {{"publish", source + "/results/published/coverage", "--out", "page"}},
          {{"diagnose", "rec.csv", "--json", "gap.json", "--html", "gap.html"}, in_order},
          {{"blind-check", studies + "blind_check.json", "--out", "blind"}, in_order},
          {{"blind-check", studies + "blind_check.json", "--export", "exported"}, in_order},
          {{"list"}},
          {{"validate", "long.json"}},
          {{"schema"}},
          {{"completion", "bash"}}};
}

/// A study whose first trial is far away, behind a search that does not look at the clock.
std::string tuned_for_long() {
  return R"({"cells": [{"name": "tuned", "trials": 3, "tuning": {"trials": 50, "evaluations": 1000},
      "filters": [{"filter": "stf", "tune": {"softening": [1, 10]}}],
      "scenario": {"duration_s": 2000, "rate_hz": 50}}]})";
}

void write_inputs(const TestFolder& folder) {
  const auto study = [](const char* name, int trials, double duration_s, const char* filters) {
    return fmt::format(R"({{"cells": [{{"name": "{}", "trials": {}, "filters": {},
        "scenario": {{"duration_s": {}, "rate_hz": 50}}}}]}})",
                       name, trials, filters, duration_s);
  };
  folder.write("long.json", study("long", 100000, 2000, R"(["none", "kf"])"));
  folder.write("small.json",
               R"({"cells": [{"name": "small", "trials": 10, "filters": ["none", "kf"],
      "scenario": {"duration_s": 20, "rate_hz": 50},
      "design": {"kind": "one_at_a_time", "parameters": {
          "scenario.random_error.phi": {"from": 0.1, "to": 0.9}}}}]})");
  folder.write("tuned.json", tuned_for_long());
  folder.write("ledger.json", R"({"claims": [{"claim": "c", "study": "long.json",
      "method": "kf", "than": "none", "metric": "bias_rmse"}]})");
  folder.write("match.json", R"({"study": "long.json", "trials": 100, "free": [
      {"path": "scenario.random_error.phi", "low": 0.1, "high": 0.9}], "targets": [
      {"cell": "long", "method": "none", "metric": "rate_std", "value": 0.2}]})");
  ASSERT_EQ(run_program(folder, {"run", "small.json"}).exit_code, 0);
  folder.write("rare.json",
               R"({"cells": [{"name": "rare", "trials": 120, "filters": ["none"],
      "failure": {"metric": "bias_rmse", "above": 0},
      "scenario": {"duration_s": 20, "rate_hz": 50}}]})");
  ASSERT_EQ(run_program(folder, {"run", "rare.json"}).exit_code, 0);
  folder.write("rec_study.json", study("rec", 1, 4000, R"(["none"])"));
  ASSERT_EQ(run_program(folder, {"simulate", "rec_study.json", "--out", "rec.csv"}).exit_code, 0);
}

/// Where a signal that comes `moment` after the start breaks the law above; empty where it does
/// not.
std::string breach(const TestFolder& folder, const Call& call, int signal,
                   std::chrono::milliseconds moment) {
  // The aim is a second; a machine that is busy with other tests is given some more.
  constexpr auto a_second = std::chrono::milliseconds(3000);
  Program program(folder.path(), call.words);
  std::this_thread::sleep_for(moment);
  const auto asked = Clock::now();
  program.send(signal);
  const auto ended = program.wait();
  const auto took = Clock::now() - asked;
  // Done before; as told; before it listened, or before a verb asked to end in good order.
  std::set<int> allowed = {0, 128 + signal, -signal};
  if (call.ends_in_order) allowed.insert(4);
  if (!allowed.contains(ended.exit_code)) return fmt::format("exit code {}", ended.exit_code);
  if (took > a_second)
    return fmt::format("took {} ms",
                       std::chrono::duration_cast<std::chrono::milliseconds>(took).count());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    if (entry.path().filename().string().find(".tmp") != std::string::npos)
      return "left " + entry.path().string();
  return "";
}

TEST(Signals, EndEveryVerbWithinASecondAndLeaveNothingHalfWritten) {
  const TestFolder folder;
  write_inputs(folder);
  int signal = SIGINT;
  for (const auto& call : calls())
    for (const int moment_ms : {20, 250}) {
      const auto found = breach(folder, call, signal, std::chrono::milliseconds(moment_ms));
      EXPECT_EQ(found, "") << fmt::format("gyrostat {} after {} ms, signal {}",
                                          fmt::join(call.words, " "), moment_ms, signal);
      signal = signal == SIGINT ? SIGTERM : SIGINT;
    }
}

TEST(Signals, AreTestedForEveryVerb) {
  std::set<std::string> tested;
  for (const auto& call : calls()) tested.insert(call.words.front());
  for (const auto& file : std::filesystem::directory_iterator(source + "/experiments/cli/verbs")) {
    if (file.path().extension() != ".cpp") continue;
    auto verb = file.path().stem().string();
    std::replace(verb.begin(), verb.end(), '_', '-');
    EXPECT_THAT(tested, testing::Contains(verb));
  }
}

TEST(Signals, ARunThatCannotEndInTimeIsResumed) {
  const TestFolder folder;
  folder.write("slow.json", tuned_for_long());
  Program program(folder.path(), {"run", "slow.json"});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  program.send(SIGTERM);
  const auto ended = program.wait();
  EXPECT_EQ(ended.exit_code, 4);
  EXPECT_THAT(ended.err, testing::HasSubstr("the same command goes on"));
}

}  // namespace
}  // namespace gyrostat::signals_test
