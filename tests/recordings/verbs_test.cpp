// Every recording at hand goes through the verbs, or is refused with what to do.

#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/tests/places.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::verbs_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

struct Row {
  const char* name;
  const char* axis;
  const char* resample = "";  ///< where its rate changes: what the refusal names
  const char* said = "";      ///< of what was done to it
};

const Row table[] = {
    {"cubesat_cooldown.csv.gz", "x", "", "are missing"},
    {"memsense_ms_imu3025_00_static.csv.gz", "y"},
    {"mpu6050_cooling.csv.gz", "z", "12.7", "put on a clock of"},
    {"mpu6050_turning.csv.gz", "z", "", "stamps are not"},
    {"px4_auav_x21.ulg", "z", "", "topic sensor_combined"},
    {"px4_auav_x21_static.csv.gz", "z", "", "of 14387 samples"},
    {"xsens_dot_01_static.csv.gz", "z", "", "taken as missing"},
};

TEST(Verbs, AllRecordingsGoThroughTheVerbs) {
  const fs::path folder = places::recordings();
  if (!fs::exists(folder / table[0].name))
    GTEST_SKIP() << folder << " is absent; GYROSTAT_RECORDINGS names the folder of recordings";
  const TestFolder here;
  for (const auto& row : table)
    for (const char* verb : {"allan", "fit", "apply"}) {
      if (std::string_view(verb) == "apply" && fs::file_size(folder / row.name) > 300'000) continue;
      std::vector<std::string> words = {verb, (folder / row.name).string(), "--axis", row.axis};
      if (std::string_view(verb) == "fit") words.insert(words.end(), {"--method", "moments"});
      if (*row.resample != '\0') {
        const auto refused = run_program(here, words);
        EXPECT_EQ(refused.exit_code, 2) << row.name;
        EXPECT_THAT(refused.err, HasSubstr(std::string("--resample ") + row.resample));
        words.insert(words.end(), {"--resample", row.resample});
      }
      const auto ended = run_program(here, words);
      if (std::string_view(row.name).starts_with("cubesat") && std::string_view(verb) != "allan") {
        EXPECT_EQ(ended.exit_code, 2);
        EXPECT_THAT(ended.err, AllOf(HasSubstr("is 25 bursts"), HasSubstr("--from and --to")));
        continue;
      }
      EXPECT_EQ(ended.exit_code, 0) << verb << ' ' << row.name << ": " << ended.err;
      EXPECT_THAT(ended.err, HasSubstr(row.said)) << row.name;
      EXPECT_THAT(ended.out, Not(HasSubstr("nan"))) << verb << ' ' << row.name;
    }
}

TEST(Verbs, BurstsAreRefusedWithWhatCanBeDone) {
  const TestFolder here;
  std::string rows = "t_s,gyro_dps\n";
  for (const int first : {0, 15000})
    for (int i = 0; i < 250; ++i)
      rows += fmt::format("{:.2f},{}\n", 0.02 * (first + i), (i * 7919) % 101);
  here.write("bursts.csv", rows);
  const auto refused = run_program(here, {"apply", "bursts.csv"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("is 2 bursts"), HasSubstr("from 0 to 5 s")));
  const auto pause = run_program(here, {"fit", "bursts.csv", "--from", "10", "--to", "100"});
  EXPECT_EQ(pause.exit_code, 2);
  EXPECT_THAT(pause.err, AllOf(HasSubstr("pauses between 10 and 100 s"), HasSubstr("to 4.98 s"),
                               HasSubstr("from 300 s")));
  EXPECT_EQ(run_program(here, {"apply", "bursts.csv", "--from", "0", "--to", "5"}).exit_code, 0);
  // Of one burst, moments can tell nothing; the likelihood can.
  const auto fit = run_program(here, {"fit", "bursts.csv", "--from", "0", "--to", "5"});
  EXPECT_THAT(fit.out, AllOf(HasSubstr("likelihood  "), HasSubstr("moments left out: bursts.csv"),
                             HasSubstr("at least 512 are needed")));
  EXPECT_EQ(
      run_program(here, {"fit", "bursts.csv", "--from", "0", "--to", "5", "--method", "moments"})
          .exit_code,
      2);
}

}  // namespace
}  // namespace gyrostat::verbs_test
