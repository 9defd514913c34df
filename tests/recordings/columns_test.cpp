#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/column_table.hpp>
#include <gyrostat/recordings/recording.hpp>

namespace gyrostat::columns_test {

using testing::ElementsAre;
using testing::HasSubstr;

ColumnTable table() {
  ColumnTable columns;
  columns.add("Time", {0.0, 10.0, 20.0});
  columns.add("gyro_z_mdps", {1.0, 2.0, 3.0});
  columns.add("comment", {0.0, 0.0, 0.0});
  return columns;
}

TEST(RecordingOfColumns, HasTheNamesAndUnitsOfFiles) {
  RecordingLayout layout;
  layout.columns = {{"t", "Time[ms]"}, {"gyro", "gyro_z_mdps[mdps]"}};
  const auto recording = recording_of_columns(table(), "memory", "", layout);
  EXPECT_THAT(recording.series.t_s, ElementsAre(0.0, 0.01, 0.02));
  EXPECT_THAT(recording.series.gyro_dps, ElementsAre(0.001, 0.002, 0.003));
  EXPECT_THAT(recording.ignored_columns, ElementsAre("comment"));
}

TEST(RecordingOfColumns, ComplainsUnderTheNameThatItIsGiven) {
  try {
    recording_of_columns(table(), "memory");
    FAIL() << "there is no t_s";
  } catch (const InputError& mistake) {
    EXPECT_THAT(mistake.what(), HasSubstr("memory"));
  }
}

}  // namespace gyrostat::columns_test
