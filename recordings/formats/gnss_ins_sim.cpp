#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/csv_table.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/input_file.hpp>

namespace gyrostat::formats::gnss_ins_sim {
namespace {

bool recognises(const FormatHead& head) {
  return head.columns() == 3 &&
         (head.has_all({"gyro_x (deg/s)", "gyro_y (deg/s)", "gyro_z (deg/s)"}) ||
          head.has_all({"gyro_x (rad/s)", "gyro_y (rad/s)", "gyro_z (rad/s)"}));
}

ColumnTable read(const FormatSource& source) {
  ColumnTable table = csv_table(*source.file);
  for (const auto& name : table.names)
    for (const std::string axis : {"x", "y", "z"})
      if (name.starts_with("gyro_" + axis)) table.layout.columns["gyro_" + axis] = name;
  const auto beside = source.path.parent_path() / "time.csv";
  if (!std::filesystem::exists(beside)) return table;
  InputFile times(beside);
  auto time = csv_table(times);
  table.layout.columns["t"] = time.names.front();
  table.add(time.names.front(), std::move(time.values.front()));
  table.notes.push_back("times of " + beside.string());
  return table;
}

}  // namespace

/// `gyro-0.csv` of gnss-ins-sim, three rates a row, whose times are in `time.csv` beside it;
/// without that, `--rate` says them (github.com/Aceinna/gnss-ins-sim, ins_data_manager.py).
RecordingFormat format() {
  return {.title = "gnss-ins-sim: gyro-0.csv, with time.csv beside it",
          .recognises = recognises,
          .read = read};
}

}  // namespace gyrostat::formats::gnss_ins_sim
