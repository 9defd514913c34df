#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/calendar.hpp>
#include <gyrostat/recordings/csv_table.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/input_file.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat::formats::kitti_oxts {
namespace {

namespace fs = std::filesystem;

/// ax, ay, az, … wx, wy, wz are the values 12 to 14 and 18 to 20 of a row, counted from 1.
constexpr std::size_t values_a_row = 30, first_acceleration = 12, first_rate = 18;

/// `oxts` itself, whether it or the drive above it is named.
fs::path folder_of(const fs::path& path) {
  for (const auto& folder : {path, path / "oxts"})
    if (fs::is_directory(folder / "data") && fs::exists(folder / "timestamps.txt")) return folder;
  return {};
}

std::vector<double> times(const fs::path& file) {
  const auto text = read_text(file);
  std::vector<double> times;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find('\n', begin), text.size());
    auto line = std::string_view(text).substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty()) {
      const auto time = seconds_of_calendar(line);
      if (!time)
        throw InputError(fmt::format("{}:{}", file.string(), times.size() + 1),
                         fmt::format("'{}' is no time; allowed: as 2011-09-26 13:02:25.964389445",
                                     printable(line.substr(0, 40))));
      times.push_back(*time - (times.empty() ? 0.0 : times.front()));
    }
    begin = end + 1;
  }
  if (!times.empty()) times.front() = 0.0;
  return times;
}

ColumnTable read(const FormatSource& source) {
  const auto folder = folder_of(source.path);
  if (folder.empty())
    throw InputError(source.place,
                     "is no drive of KITTI; required: a folder with timestamps.txt and data");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "data"))
    if (entry.path().extension() == ".txt") files.push_back(entry.path());
  std::ranges::sort(files);
  auto stamps = times(folder / "timestamps.txt");
  if (stamps.size() != files.size())
    throw InputError(source.place, fmt::format("{} files in data, {} times in timestamps.txt; "
                                               "required: equally many",
                                               files.size(), stamps.size()));
  ColumnTable table;
  table.add("t", std::move(stamps));
  for (const std::string name : {"acc_x", "acc_y", "acc_z", "gyro_x", "gyro_y", "gyro_z"})
    table.add(name, {});
  for (const auto& file : files) {
    InputFile input(file);
    const auto row = csv_table(input);
    if (row.names.size() != values_a_row || row.values.front().size() != 1)
      throw InputError(file.string(), fmt::format("{} columns and {} rows; required: 30 and 1",
                                                  row.names.size(), row.values.front().size()));
    for (std::size_t k = 0; k < 3; ++k) {
      table.values[1 + k].push_back(row.values[first_acceleration - 1 + k].front());
      table.values[4 + k].push_back(row.values[first_rate - 1 + k].front());
    }
  }
  table.layout.columns["t"] = "t";
  table.layout.units["t"] = "s";
  for (const std::string axis : {"x", "y", "z"}) {
    table.layout.columns["gyro_" + axis] = "gyro_" + axis;
    table.layout.units["gyro_" + axis] = "rad/s";
    table.layout.columns["acc_" + axis] = "acc_" + axis;
    table.layout.units["acc_" + axis] = "m/s2";
  }
  return table;
}

}  // namespace

/// The folder `oxts` of a drive of KITTI's raw data (or the drive): `timestamps.txt`, and a file of
/// 30 numbers for each moment in `data`, of which wx, wy, wz are rates in rad/s (dataformat.txt of
/// the development kit; Geiger et al., IJRR 2013).
RecordingFormat format() {
  return {.title = "KITTI raw: the folder oxts of a drive",
          .recognises = [](const FormatHead& head) { return !folder_of(head.path).empty(); },
          .read = read};
}

}  // namespace gyrostat::formats::kitti_oxts
