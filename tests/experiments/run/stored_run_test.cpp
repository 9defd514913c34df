// What an overnight run must survive, seen from outside: the program on a small study, killed,
// starved, split and resumed. Its canonical export is always that of a run that nobody disturbed.

#include <gyrostat/experiments/run/stored_run.hpp>

#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/shard.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/run/time_of_day.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/experiments/study/address.hpp>
#include <gyrostat/experiments/study/digest.hpp>
#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::stored_run_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Some seconds of work in many short trials; one filter breaks down in some of them.
constexpr const char* study = R"({"seed": 11, "cells": [
    {"name": "short", "trials": 3000, "scenario": {"duration_s": 10, "rate_hz": 50},
     "filters": ["none", "kf", "sr_rsukf"]},
    {"name": "a:b, c", "trials": 500, "parameters_from": "truth",
     "scenario": {"duration_s": 20, "rate_hz": 50},
     "filters": ["none", {"id": "bold", "filter": "sr_rsukf", "parameters": {"mu_phi": 100}}]}]})";

std::string undisturbed() {
  static const std::string outcomes = [] {
    const TestFolder folder;
    folder.write("s.json", study);
    EXPECT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
    return run_program(folder, {"export", "runs/s"}).out;
  }();
  return outcomes;
}

TestFolder& with_study(TestFolder& folder) {
  folder.write("s.json", study);
  return folder;
}

/// The same command to its end: what it exports is what an undisturbed run exports.
void expect_resumed(const TestFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> command = {"run", "s.json"};
  command.insert(command.end(), more.begin(), more.end());
  const auto ended = run_program(folder, command);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(run_program(folder, {"export", "runs/s"}).out == undisturbed());
}

std::size_t finished_in(const TestFolder& folder) {
  std::size_t sum = 0;
  for (const auto& cell : Store::open(folder.path() / "runs/s").manifest().cells)
    sum += cell.finished;
  return sum;
}

/// Whether the run has noted how far it is, which follows the batch that it tells of.
bool has_noted_progress(const TestFolder& folder) {
  const auto sessions = Store::open(folder.path() / "runs/s").sessions();
  return !sessions.empty() && sessions.back().progress.size() > 2;
}

/// Lets the program run until something is in the store, then kills it.
void kill_half_way(const TestFolder& folder) {
  Program program(folder.path(), {"run", "s.json"});
  while (true) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    try {
      if (finished_in(folder) > 200 && has_noted_progress(folder)) break;
    } catch (const std::runtime_error&) {  // not there yet
    }
  }
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().exit_code, -SIGKILL);
}

TEST(Store, AResumedStudyEqualsAnUninterruptedOne) {
  TestFolder folder;
  kill_half_way(with_study(folder));
  const auto kept = finished_in(folder);
  EXPECT_LT(kept, 3500U);
  expect_resumed(folder);
}

// Fifty kills and more, at moments that a printed seed decides.
TEST(Store, SurvivesBeingKilledAtRandomMoments) {
  const auto seed = std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  TestFolder folder;
  with_study(folder);
  int kills = 0;
  for (int tries = 0; kills < 55 && tries < 400; ++tries) {
    // A run that has come to its end is set back, so that kills meet every stage of one.
    if (fs::exists(folder.path() / "runs/s/tables.md")) fs::remove_all(folder.path() / "runs");
    Program program(folder.path(), {"run", "s.json"});
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 150'000));
    program.send(SIGKILL);
    const auto ended = program.wait();
    ASSERT_TRUE(ended.exit_code == -SIGKILL || ended.exit_code == 0) << ended.err;
    kills += ended.exit_code == -SIGKILL;
  }
  EXPECT_GE(kills, 50);
  expect_resumed(folder);
  EXPECT_FALSE(fs::exists(folder.path() / "runs/s/store.db-wal")) << "nobody is at work any more";
}

TEST(Store, SurvivesALogThatAPowerCutHasTruncated) {
  std::mt19937 random(5);
  TestFolder folder;
  kill_half_way(with_study(folder));
  const auto log = folder.path() / "runs/s/store.db-wal";
  ASSERT_TRUE(fs::exists(log));
  const TestFolder kept;
  fs::copy(folder.path(), kept.path(), fs::copy_options::recursive);
  for (const double share : {0.0, 0.3, 0.6, 0.999}) {
    SCOPED_TRACE(share);
    TestFolder cut;
    fs::copy(kept.path(), cut.path(), fs::copy_options::recursive);
    const auto length = fs::file_size(log);
    fs::resize_file(cut.path() / "runs/s/store.db-wal",
                    static_cast<std::uintmax_t>(share * static_cast<double>(length)));
    fs::remove(cut.path() / "runs/s/store.db-shm");
    expect_resumed(cut);
  }
}

TEST(Store, AFileThatMayNotGrowIsAnErrorAndTheRunGoesOnLater) {
  TestFolder folder;
  with_study(folder);
  constexpr std::size_t before = 20;  // of each cell, so that something is there to be kept
  EXPECT_EQ(run_program(folder, {"run", "s.json", "--trials", std::to_string(before)}).exit_code,
            0);
  const auto command = fmt::format("cd {} && ulimit -f 3000 && {} run s.json 2> err > out",
                                   folder.path().string(), places::program());
  const int status = std::system(("/bin/sh -c '" + command + "'").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(folder.read("err"), HasSubstr("finished trials are kept"));
  EXPECT_GE(finished_in(folder), 2 * before);
  expect_resumed(folder);
}

TEST(Store, AFullDiskIsAnErrorAndTheRunGoesOnLater) {
  TestFolder folder;
  with_study(folder);
  const auto disk = folder.path() / "runs";
  fs::create_directory(disk);
  if (std::system(
          fmt::format("mount -t tmpfs -o size=300k gyrostat_test {} 2> /dev/null", disk.string())
              .c_str()) != 0)
    GTEST_SKIP() << "a small disk cannot be mounted here";
  const auto ended = run_program(folder, {"run", "s.json"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("the disk is full"), HasSubstr("finished trials are kept")));
  EXPECT_EQ(std::system(fmt::format("mount -o remount,size=64m {}", disk.string()).c_str()), 0);
  expect_resumed(folder);
  EXPECT_EQ(std::system(("umount " + disk.string()).c_str()), 0);
}

TEST(Store, AFolderThatCannotBeWrittenToIsRefusedBeforeAnyWork) {
  TestFolder folder;
  kill_half_way(with_study(folder));
  const auto runs = (folder.path() / "runs").string();
  if (std::system(
          fmt::format(
              "mount --bind {0} {0} 2> /dev/null && mount -o remount,ro,bind {0} 2> /dev/null",
              runs)
              .c_str()) != 0)
    GTEST_SKIP() << "a folder cannot be made read-only for this user";
  const auto ended = run_program(folder, {"run", "s.json"});
  EXPECT_NE(ended.exit_code, 0);
  EXPECT_THAT(ended.err, HasSubstr("cannot be written to"));
  EXPECT_EQ(std::system(("umount " + runs).c_str()), 0);
  expect_resumed(folder);
}

TEST(Store, ADamagedStoreIsRefusedAndKeptWhereTheRunBeginsAnew) {
  TestFolder folder;
  kill_half_way(with_study(folder));
  fs::remove(folder.path() / "runs/s/store.db-wal");
  folder.write("runs/s/store.db", "this is not what it was");
  const auto refused = run_program(folder, {"run", "s.json"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("is damaged"), HasSubstr("--set-aside")));
  EXPECT_EQ(folder.read("runs/s/store.db"), "this is not what it was");
  expect_resumed(folder, {"--set-aside"});
  EXPECT_EQ(folder.read("runs/s/store-1.db"), "this is not what it was");
}

TEST(Store, MoreTrialsAreAddedToThoseThatAreThere) {
  TestFolder folder;
  with_study(folder);
  EXPECT_EQ(run_program(folder, {"run", "s.json", "--trials", "100"}).exit_code, 0);
  const auto before = Store::open(folder.path() / "runs/s").sessions().size();
  expect_resumed(folder);
  EXPECT_EQ(before, 1U);
  EXPECT_EQ(Store::open(folder.path() / "runs/s").sessions().size(), 2U);
}

// Tuning signals have addresses of their own, so tuned values do not move with the number of
// trials.
TEST(Store, MoreTrialsOfATunedStudyLeaveTheFirstAsTheyWere) {
  const TestFolder folder;
  folder.write(
      "t.json",
      R"({"cells": [{"name": "t", "trials": 6, "scenario": {"duration_s": 5, "rate_hz": 50},
      "parameters_from": "truth", "tuning": {"trials": 2, "evaluations": 8},
      "filters": ["none", {"filter": "kf", "tune": {"phi": [0.1, 0.9]}}]}]})");
  run_program(folder, {"run", "t.json", "--trials", "3"});
  const auto few = run_program(folder, {"export", "runs/t"}).out;
  run_program(folder, {"run", "t.json", "--out", "fresh"});
  const auto many = run_program(folder, {"export", "fresh"}).out;
  EXPECT_TRUE(many.starts_with(few));
  EXPECT_GT(many.size(), few.size());
}

TEST(Store, AChangedStudyIsRefusedUnlessToldSo) {
  TestFolder folder;
  with_study(folder);
  const std::vector<std::string> command = {"run", "s.json", "--trials", "20"};
  EXPECT_EQ(run_program(folder, command).exit_code, 0);
  auto changed = std::string(study);
  changed.replace(changed.find("\"seed\": 11"), 10, "\"seed\": 12");
  folder.write("s.json", changed);
  const auto refused = run_program(folder, command);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("before it was changed"), HasSubstr("--mix"),
                                 HasSubstr("--set-aside"), HasSubstr("--out")));
  auto mixed = command;
  mixed.push_back("--mix");
  EXPECT_EQ(run_program(folder, mixed).exit_code, 0);
}

TEST(Store, OutcomesOfAnotherBuildAreRefusedUnlessToldSo) {
  TestFolder folder;
  const Study read = read_study((with_study(folder).path() / "s.json").string());
  const auto out = folder.path() / "runs/s";
  fs::create_directories(out);
  {
    auto store = Store::open_or_create(out, manifest_of(read));
    store.set_cells(manifest_of(read).cells);
    store.begin_session(
        {read.digest, {"0.0.9 abc", "cc", "-O0"}, "there", 1, "2026-01-01T00:00:00Z", "", 0});
    std::vector<Workspace> workspace(1);
    store.write(std::vector{row_of(1, 0, run_trial(read.cells[1], {}, read.seed, 0, workspace))});
  }
  const auto refused = run_program(folder, {"run", "s.json"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("holds outcomes of build 0.0.9 abc (cc, -O0), not"),
                                 HasSubstr("--mix")));
  expect_resumed(folder, {"--mix"});
}

// ---------------------------------------------------------------- what decides an outcome

std::string digest_of(const std::string& json) { return study_digest(Json::parse(json), "s.json"); }

TEST(Digest, IsThatOfAllThatDecidesAnOutcome) {
  const auto base = digest_of(R"({"cells": [{"name": "a", "scenario": {"rate_hz": 50}}]})");
  EXPECT_EQ(digest_of(R"({"title": "t", "failure_budget": 0.1, "seed": 1,
                          "cells": [{"trials": 7, "scenario": {"rate_hz": 50}, "name": "a"}]})"),
            base);
  EXPECT_NE(digest_of(R"({"seed": 2, "cells": [{"name": "a", "scenario": {"rate_hz": 50}}]})"),
            base);
  EXPECT_NE(digest_of(R"({"cells": [{"name": "a", "scenario": {"rate_hz": 51}}]})"), base);
  EXPECT_NE(
      digest_of(R"({"cells": [{"name": "a", "filters": ["kf"], "scenario": {"rate_hz": 50}}]})"),
      base);
}

TEST(Digest, IsThatOfARecordingsContentsNotOfItsName) {
  const TestFolder folder;
  folder.write("a.csv", "1");
  folder.write("b.csv", "1");
  folder.write("c.csv", "2");
  const auto of = [&](const std::string& file) {
    const Json json = {{"cells", {{{"scenario", {{"from_recording", {{"file", file}}}}}}}}};
    return study_digest(json, (folder.path() / "s.json").string());
  };
  EXPECT_EQ(of("a.csv"), of("b.csv"));
  EXPECT_NE(of("a.csv"), of("c.csv"));
}

// ---------------------------------------------------------------- shards

TEST(Shard, EveryTrialHasOneOwner) {
  for (const std::uint32_t count : {1U, 2U, 7U})
    for (const std::uint32_t trials : {1U, 6U, 100U}) {
      std::uint32_t shares = 0;
      for (std::uint32_t i = 1; i <= count; ++i) {
        const Shard shard{i, count};
        std::uint32_t owned = 0;
        for (std::uint32_t t = 0; t < trials; ++t) owned += shard.owns(t);
        EXPECT_EQ(owned, shard.share_of(trials));
        shares += owned;
      }
      EXPECT_EQ(shares, trials);
    }
}

TEST(Shard, ATaskOfASlurmArrayKnowsItsOwn) {
  std::map<std::string, std::string> variables = {{"SLURM_ARRAY_TASK_ID", "12"},
                                                  {"SLURM_ARRAY_TASK_MIN", "10"},
                                                  {"SLURM_ARRAY_TASK_MAX", "17"},
                                                  {"SLURM_ARRAY_TASK_COUNT", "8"}};
  const auto environment = [&](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  };
  EXPECT_EQ(slurm_shard(environment)->index, 3U);
  EXPECT_EQ(slurm_shard(environment)->count, 8U);
  variables["SLURM_ARRAY_TASK_COUNT"] = "2";  // sbatch --array=10,17
  EXPECT_THROW(slurm_shard(environment), InputError);
  variables.clear();
  EXPECT_FALSE(slurm_shard(environment).has_value());
}

TEST(Shard, MergedShardsEqualTheSingleRunByteForByte) {
  TestFolder folder;
  with_study(folder);
  for (const char* shard : {"1/3", "2/3", "3/3"})
    EXPECT_EQ(run_program(folder, {"run", "s.json", "--shard", shard}).exit_code, 0);
  const std::vector<std::string> merge = {"merge", "runs/s", "runs/s/shard_3_of_3",
                                          "runs/s/shard_1_of_3"};
  EXPECT_EQ(run_program(folder, merge).exit_code, 4) << "a shard is missing";
  auto all = merge;
  all.push_back("runs/s/shard_2_of_3");
  for (int again = 0; again < 2; ++again) {
    EXPECT_EQ(run_program(folder, all).exit_code, 0);
    EXPECT_TRUE(run_program(folder, {"export", "runs/s"}).out == undisturbed());
  }
  EXPECT_EQ(run_program(folder, {"run", "s.json", "--out", "single"}).exit_code, 0);
  expect_resumed(folder);
  for (const std::string file : {"outcomes.csv.gz", "tables.json", "tables.md"})
    EXPECT_TRUE(folder.read("runs/s/" + file) == folder.read("single/" + file)) << file;
}

TEST(Shard, OfAnotherStudyIsNotMerged) {
  TestFolder folder;
  with_study(folder);
  folder.write("other.json", R"({"seed": 3, "cells": [{"trials": 2, "filters": ["none"]}]})");
  run_program(folder, {"run", "s.json", "--trials", "2"});
  run_program(folder, {"run", "other.json"});
  const auto before = folder.contents();
  const auto refused = run_program(folder, {"merge", "runs/s", "runs/other"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("is of another study"));
  EXPECT_TRUE(folder.contents() == before);
}

// ---------------------------------------------------------------- quarantine

TEST(Quarantine, ATrialThatBreaksDownHasAnAddressThatReplaysIt) {
  TestFolder folder;
  with_study(folder);
  EXPECT_EQ(run_program(folder, {"run", "s.json", "--trials", "20"}).exit_code, 0);
  const auto listed =
      Json::parse(run_program(folder, {"status", "runs/s", "--failures", "--format", "json"}).out);
  ASSERT_FALSE(listed[0]["rows"].empty()) << "the study has a filter that breaks down";
  const auto address = listed[0]["rows"][0][0].get<std::string>();
  EXPECT_THAT(address, AllOf(testing::StartsWith("s:a:b, c:"), testing::EndsWith(":bold")));
  const auto replayed = run_program(folder, {"replay", address});
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_THAT(replayed.out,
              AllOf(HasSubstr("in quarantine: " + listed[0]["rows"][0][1].get<std::string>()),
                    HasSubstr("the same outcome, to the bit")));
  const auto steps = run_program(folder, {"replay", address, "--study", "s.json", "--steps"}).out;
  EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), 1 + 1000);
  EXPECT_THAT(steps, HasSubstr(",risk_breakdown\n"));
}

TEST(Quarantine, WhatAMethodThrowsHarmsNeitherTheOthersNorTheRun) {
  const TestFolder folder;
  folder.write("q.json", R"({"cells": [{"name": "q", "trials": 3, "filters": ["none"],
                                        "scenario": {"duration_s": 1, "rate_hz": 50}}]})");
  Study broken = read_study((folder.path() / "q.json").string());
  auto& cell = broken.cells[0];
  cell.methods.push_back({"gone", "gone", ParameterSource::truth, {}, {}});
  Store store = open_study_store(folder.path(), broken, Mismatch::refuse);
  CellState state(store, cell, 0, {});
  run_missing(store, {cell, {}, {}}, 0, broken.seed, state, {}, [](const CellProgress&) {});
  std::vector<std::string> addresses;
  store.for_each_failure([&](const Failure& failure) {
    addresses.push_back(
        address_text("q", cell.name, failure.trial, cell.methods[failure.method].id));
    EXPECT_THAT(failure.reason, HasSubstr("threw: gone: unknown filter"));
  });
  EXPECT_THAT(addresses, testing::ElementsAre("q:q:0:gone", "q:q:1:gone", "q:q:2:gone"));
  EXPECT_EQ(CellState(store, cell, 0, {}).missing(), 0U) << "it would throw again";
  EXPECT_THROW(run_cell(cell, broken.seed, {}), std::runtime_error);
}

TEST(Quarantine, MoreFailuresThanTheBudgetEndTheRunWithThree) {
  TestFolder folder;
  with_study(folder);
  const auto over =
      run_program(folder, {"run", "s.json", "--trials", "20", "--failure-budget", "0.01"});
  EXPECT_EQ(over.exit_code, 3);
  EXPECT_THAT(over.err, HasSubstr("failures over the budget"));
  EXPECT_EQ(
      run_program(folder, {"run", "s.json", "--trials", "20", "--failure-budget", "1"}).exit_code,
      0);
}

TEST(Address, NamesWhatTheStudyHasNot) {
  TestFolder folder;
  const Study read = read_study((with_study(folder).path() / "s.json").string());
  const auto at = parse_address("s:a:b, c:17:bold", read);
  EXPECT_EQ(at.cell, 1U);
  EXPECT_EQ(at.trial, 17U);
  EXPECT_EQ(at.method, 1U);
  const auto said = [&](const std::string& address) -> std::string {
    try {
      parse_address(address, read);
    } catch (const InputError& mistake) {
      return mistake.what();
    }
    return "";
  };
  EXPECT_THAT(said("s:shrt:17:kf"), HasSubstr("did you mean 'short'"));
  EXPECT_THAT(said("s:short:17:fk"), HasSubstr("did you mean 'kf'"));
  EXPECT_THAT(said("s:short:x:kf"), HasSubstr("'x' is no trial number"));
  EXPECT_THAT(said("short:kf"), HasSubstr("study:cell:trial:filter"));
}

// ---------------------------------------------------------------- watching

TEST(Watching, StatusReadsARunThatIsUnderWayAndTheLogIsJsonLines) {
  TestFolder folder;
  kill_half_way(with_study(folder));
  const auto status =
      Json::parse(run_program(folder, {"status", "runs/s", "--format", "json"}).out);
  EXPECT_EQ(status[0]["rows"][0][0], "short");
  EXPECT_GT(status[0]["rows"][0][1].get<int>(), 200);
  EXPECT_THAT(
      status[1]["rows"][0][3].get<std::string>(),
      AllOf(HasSubstr("short: "), HasSubstr("trials/s"), HasSubstr("s left"), HasSubstr("widest")));
  expect_resumed(folder);
  std::istringstream log(folder.read("runs/s/log.jsonl"));
  std::vector<std::string> events;
  for (std::string line; std::getline(log, line);) events.push_back(Json::parse(line).at("event"));
  EXPECT_EQ(events.front(), "start");
  EXPECT_EQ(events.back(), "end");
}

TEST(Watching, TheNextTimeOfDayIsAheadAndWithinADay) {
  const auto now = std::time(nullptr);
  for (const char* text : {"00:00", "07:00", "23:59"}) {
    const auto next = next_time_of_day(text, now);
    EXPECT_GT(next, now);
    EXPECT_LE(next, now + 25 * 3600);  // a day may have 25 hours
    std::tm local{};
    localtime_r(&next, &local);
    EXPECT_EQ(fmt::format("{:02}:{:02}", local.tm_hour, local.tm_min), text);
  }
  for (const char* text : {"", "7:00", "24:00", "07:60", "07-00", "noon"})
    EXPECT_THROW(next_time_of_day(text, now), InputError) << text;
}

TEST(Plan, CountsTrialsFiltersStepsTimeAndDiskAndWritesNothing) {
  TestFolder folder;
  with_study(folder);
  const auto before = folder.contents();
  const auto ended = run_program(
      folder, {"plan", "s.json", "--pilot", "0.05", "--trials", "1000000", "--format", "json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto rows = Json::parse(ended.out)[0]["rows"];
  ASSERT_EQ(rows.size(), 3);
  EXPECT_EQ(rows[0][1], 1000000);
  EXPECT_EQ(rows[0][2], 3);
  EXPECT_EQ(rows[0][3], 500);
  EXPECT_EQ(rows[0][4], 1.5e9);
  EXPECT_GT(rows[0][6].get<double>(), 0.0);
  EXPECT_GT(rows[0][7].get<double>(), 500.0);
  EXPECT_TRUE(folder.contents() == before);
}

// The size that `plan` foretells is that of a real store, within a tenth.
TEST(Plan, ForetellsTheDisk) {
  TestFolder folder;
  with_study(folder);
  const auto ended = run_program(folder, {"plan", "s.json", "--pilot", "0.3", "--format", "json"});
  const double foretold = Json::parse(ended.out)[0]["rows"][2][7].get<double>() * 1e6;
  expect_resumed(folder);
  const auto real = static_cast<double>(fs::file_size(folder.path() / "runs/s/store.db") +
                                        fs::file_size(folder.path() / "runs/s/outcomes.csv.gz"));
  EXPECT_NEAR(foretold, real, 0.1 * real);
}

}  // namespace
}  // namespace gyrostat::stored_run_test
