// Files made to do harm, and words that miss by a letter: each is refused at once, by name, with
// what would do, and neither fills the memory nor writes where it should not.

#include <gmock/gmock.h>

#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::hostile_input_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

#ifdef __SANITIZE_ADDRESS__
constexpr long most_KiB = 1200 * 1024;  // with what the sanitizer keeps beside
#else
constexpr long most_KiB = 400 * 1024;
#endif

/// Refused with one line of usage error that has all of these parts.
void expect_refused(const TestFolder& folder, const Words& arguments, const Words& parts) {
  const auto ended = run_program(folder, arguments);
  EXPECT_EQ(ended.exit_code, 2) << ended.err.substr(0, 500);
  EXPECT_EQ(ended.out, "");
  EXPECT_LT(ended.err.size(), 10'000U);
  EXPECT_LT(ended.peak_KiB, most_KiB);
  for (const auto& part : parts) EXPECT_THAT(ended.err, HasSubstr(part));
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

TEST(HostileInput, ARecordingOfMillionsOfColumnsIsRefusedBeforeItIsSplit) {
  const TestFolder folder;
  folder.write("wide.csv.gz", gzipped(std::string(20'000'000, ',')));
  expect_refused(folder, {"fit", "wide.csv.gz"}, {"wide.csv.gz:1", "20000001 columns", "10000"});
}

TEST(HostileInput, ARecordingThatUnpacksWithoutEndIsRefusedByName) {
  const TestFolder folder;
  std::string rows = "t_s,gyro_dps\n";
  while (rows.size() < 70'000'000) rows += "0,0\n";
  folder.write("bomb.csv.gz", gzipped(rows));
  expect_refused(folder, {"fit", "bomb.csv.gz"}, {"bomb.csv.gz", "unpacks to more than"});
}

TEST(HostileInput, JsonThatIsDeepOrHasEndlessKeysIsRefused) {
  const TestFolder folder;
  folder.write("deep.json", repeated("[", 5'000'000));
  expect_refused(folder, {"validate", "deep.json"}, {"deep.json", "nested more than 64 deep"});
  std::string keys = "{\"key\": 0";
  for (int i = 0; i < 200'000; ++i) keys += ", \"k" + std::to_string(i) + "\": 1";
  folder.write("keys.json", keys + "}");
  expect_refused(folder, {"validate", "keys.json"}, {"keys.json", "more than 10000 keys"});
  keys.resize(keys.find("\"k900\""));
  folder.write("some.json", keys + "\"cells\": []}");
  const auto ended = run_program(folder, {"validate", "some.json"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr(" more\n"));
}

TEST(HostileInput, JsonThatIsNoneIsToldWithLineColumnAndReason) {
  const TestFolder folder;
  folder.write("study.json", "{\n  \"cells\": [}\n");
  expect_refused(folder, {"validate", "study.json"}, {"study.json:2:13: not valid JSON: ", "'}'"});
}

TEST(HostileInput, NothingInAFileOrACallSpeaksToTheTerminal) {
  const TestFolder folder;
  folder.write("s.json", R"({"cells": [], "\u001b[2J\u0007": 1})");
  folder.write("d.json", "\x7f{}");
  for (const Words& words : {Words{"validate", "s.json"},
                             {"validate", "d.json"},
                             {"fit", "\x1b[2J.csv"},
                             {"allan", "--\x1b[2J", "1"}}) {
    const auto ended = run_program(folder, words);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("gyrostat: "), Not(HasSubstr("\x1b")),
                                 Not(HasSubstr("\x7f")), Not(HasSubstr("\a"))));
  }
}

TEST(HostileInput, NamesThatLeadElsewhereOrAreFormulasAreRefused) {
  const TestFolder folder;
  for (const std::string name : {"=1+2", "+a", "-a", "@a"}) {
    folder.write("study.json", R"({"cells": [{"name": ")" + name + R"(", "trials": 1}]})");
    expect_refused(folder, {"validate", "study.json"}, {"cells[0].name", "spreadsheet"});
  }
  folder.write("page/page.json", R"({"output": "README.md"})");
  folder.write("page/page.md", "");
  const auto tables = [&](const std::string& names, const std::string& row) {
    folder.write("page/tables.json", R"({"names": [)" + names + R"(], "tables": [{"title": "t",
        "columns": [{"name": "a", "unit": ""}, {"name": "b", "unit": ""}], "rows": [[)" +
                                         row + R"(]], "notes": []}]})");
  };
  const Words publish = {"publish", "page", "--text"};
  tables(R"("../../elsewhere")", "1, 2");
  expect_refused(folder, publish, {"tables.json", "../../elsewhere", "no name of a table"});
  tables("1", "1, 2");
  expect_refused(folder, publish, {"tables.json", "1 in \"names\" is not a text"});
  tables(R"("t")", "1");
  expect_refused(folder, publish, {"tables.json", "not as many cells as columns"});
  tables(R"("t")", "1, 2");
  EXPECT_EQ(run_program(folder, publish).exit_code, 0);
}

TEST(HostileInput, ALineBreakInAPathBecomesNoCommandOfAJob) {
  const TestFolder folder;
  folder.write("a\ntouch owned\n/study.json", R"({"cells": [{"trials": 1}]})");
  expect_refused(folder, {"slurm", "a\ntouch owned\n/study.json", "--file", "job.sbatch"},
                 {"line break"});
  EXPECT_FALSE(folder.contents().contains("job.sbatch"));
}

TEST(Misspelt, VerbsOptionsAndAxesAreToldWhatIsMeant) {
  const TestFolder folder;
  folder.write("rec.csv", "t_s,gyro_dps\n0,1\n");
  expect_refused(folder, {"alan", "rec.csv"}, {"did you mean 'allan'?"});
  expect_refused(folder, {"fit", "rec.csv", "--axs", "x"}, {"--axs", "did you mean '--axis'?"});
  expect_refused(folder, {"fit", "rec.csv", "--axis", "q"}, {"'q' is no axis; allowed: x, y or z"});
}

}  // namespace
}  // namespace gyrostat::hostile_input_test
