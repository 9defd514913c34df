// A damaged store as its user meets it, and output that cannot go where it should.

#include <gmock/gmock.h>

#include <gyrostat/recordings/text.hpp>
#include <gyrostat/results/store.hpp>
#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::repair_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

void write_study(const TestFolder& folder) {
  folder.write("s.json", R"({"cells": [{"name": "c", "trials": 40, "filters": ["none", "kf"],
      "parameters_from": "truth", "scenario": {"duration_s": 4, "rate_hz": 20}}]})");
}

/// Takes two rows off the count of a page: they are no more there for who reads the table.
void lose_rows(const TestFolder& folder) {
  constexpr std::size_t page_size = 16384;
  auto bytes = folder.read("runs/s/store.db");
  for (std::size_t page = page_size; page < bytes.size(); page += page_size)
    if (bytes[page] == 13 && bytes[page + 4] > 2) {  // a leaf of a table with some rows
      bytes[page + 4] = static_cast<char>(bytes[page + 4] - 2);
      folder.write("runs/s/store.db", bytes);
      return;
    }
  FAIL() << "there is no such page";
}

TEST(Repair, RowsThatAreNoMoreThereAreMissedByEveryReaderAndRunAgain) {
  const TestFolder folder;
  write_study(folder);
  ASSERT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
  const auto outcomes = read_text(folder.path() / "runs/s/outcomes.csv.gz");
  lose_rows(folder);
  for (const std::string verb : {"export", "rank", "consistency", "report"}) {
    const auto ended = run_program(folder, {verb, "runs/s"});
    EXPECT_EQ(ended.exit_code, 1) << verb;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("is damaged"), HasSubstr("gyrostat repair runs/s")));
  }
  const auto merged = run_program(folder, {"merge", "all", "runs/s"});
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_THAT(merged.err, HasSubstr("runs/s/store.db: is damaged"));

  const auto repaired = run_program(folder, {"repair", "runs/s"});
  EXPECT_EQ(repaired.exit_code, 4) << repaired.err;
  EXPECT_THAT(repaired.err, HasSubstr("dropped"));
  EXPECT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
  EXPECT_EQ(read_text(folder.path() / "runs/s/outcomes.csv.gz"), outcomes);
  EXPECT_EQ(run_program(folder, {"repair", "runs/s"}).exit_code, 0);
}

/// The exit code of a line of shell in the folder, with $G the program.
int shell(const TestFolder& folder, const std::string& line) {
  const auto all =
      "cd '" + folder.path().string() + "' && G='" + places::program() + "' && " + line;
  const int status = std::system(all.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Output, ThatCannotGoAnywhereIsAnErrorAndNeverGoesIntoAFile) {
  const TestFolder folder;
  write_study(folder);
  EXPECT_EQ(shell(folder, "$G run s.json 2> err >&-"), 1);
  EXPECT_EQ(folder.read("runs/s/store.lock"), "");
  EXPECT_THAT(folder.read("err"), HasSubstr("the output cannot be written"));
  EXPECT_EQ(shell(folder, "$G run s.json --out quiet > out 2>&- <&-"), 0);
  EXPECT_EQ(folder.read("quiet/store.lock"), "");
  EXPECT_EQ(shell(folder, "$G --help > /dev/full 2> err"), 1);
  EXPECT_EQ(shell(folder, "$G --version > /dev/full 2> err"), 1);
  EXPECT_EQ(shell(folder, "$G run s.json --out read 2> err | head -c 1 > out"), 0);
  EXPECT_TRUE(fs::exists(folder.path() / "read/outcomes.csv.gz"));
  EXPECT_EQ(shell(folder, "(ulimit -f 66; $G export quiet --out out.csv 2> err)"), 1);
  EXPECT_THAT(folder.read("err"), HasSubstr("out.csv: cannot be written"));
  EXPECT_FALSE(fs::exists(folder.path() / "out.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "out.csv.tmp"));
}

TEST(Mix, IsAskedForAgainAfterOutcomesOfAnotherStudyWereMergedIn) {
  const TestFolder folder;
  write_study(folder);
  folder.write("t.json",
               R"({"seed": 9, "cells": [{"name": "c", "trials": 60, "filters": ["none", "kf"],
      "parameters_from": "truth", "scenario": {"duration_s": 4, "rate_hz": 20}}]})");
  ASSERT_EQ(run_program(folder, {"run", "s.json", "--shard", "1/2"}).exit_code, 0);
  ASSERT_EQ(run_program(folder, {"run", "t.json", "--shard", "2/2"}).exit_code, 0);
  ASSERT_EQ(run_program(folder, {"merge", "mixed", "runs/s/shard_1_of_2"}).exit_code, 4);
  const auto merged = run_program(folder, {"merge", "mixed", "runs/t/shard_2_of_2", "--mix"});
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  const auto plain = run_program(folder, {"run", "s.json", "--out", "mixed"});
  EXPECT_EQ(plain.exit_code, 2);
  EXPECT_THAT(plain.err, HasSubstr("outcomes of another study"));
}

}  // namespace
}  // namespace gyrostat::repair_test
