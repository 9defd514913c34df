#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/recordings/layout.hpp>

namespace gyrostat {

struct ColumnTable;

struct Recording {
  Series series;
  std::vector<std::string> ignored_columns;  ///< in the file's order, of no standard name
  std::string axis;                          ///< "x", "y" or "z"; empty for a column `gyro_dps`
  std::vector<std::string> taken_as;  ///< "Time as t_s in ms": what a layout made of which column
  std::size_t first_row = 2;          ///< line of sample 0; 0 in a file without lines
  std::string format;                 ///< id of the preset that it was read by; empty: its own CSV
  std::vector<std::string> notes;     ///< what was chosen, repaired or taken as missing
};

/// Reads a recording: a file of any of the `format_types()`, known by its content unless `layout`
/// says the preset; else CSV, a header and then one row a sample; both may be gzip, and "-" is
/// standard input. Names and units are those of `channels` unless the format or `layout` has
/// others. The gyro is `gyro_dps`, or `gyro_x_dps`, `gyro_y_dps`, `gyro_z_dps` chosen by `axis`
/// ("x", "y", "z"; "" takes `gyro_dps` or the only one there is); the others are then the rates
/// about the other axes, unless the file has columns of theirs. Without times, `layout` says the
/// rate. A blank cell and NaN are missing values, an infinity becomes one, a column of nothing else
/// is absent. `wanted` lists the channels that are read, all where it is empty: of a long recording
/// that saves memory. Throws InputError naming file, line, column, value and what is allowed, or
/// the converter where the format is one that cannot be read.
///
/// Example: a file with names and units of its own.
///
///   RecordingLayout layout;
///   layout.columns = parse_assignments("t=Time[ms],gyro=GyrZ", "example");
///   layout.units = parse_assignments("gyro=rad/s", "example");
///   const Recording recording = read_recording("REC.csv", "", layout);
///   for (const auto& taken : recording.taken_as) std::puts(taken.c_str());
///
/// Thread safety: may run in any number of threads at once, of MATLAB files in one at a time.
Recording read_recording(const std::filesystem::path& path, std::string_view axis = "",
                         const RecordingLayout& layout = {},
                         std::span<const std::string_view> wanted = {});

/// Stands for every axis of a recording, where a verb takes more than one.
inline constexpr std::string_view every_axis = "all";

/// None of a recording's axes was chosen, or every one, where one is read.
class AxisToChoose : public InputError {
 public:
  AxisToChoose(std::string_view place, std::string_view problem, std::vector<std::string> found)
      : InputError(place, problem), axes(std::move(found)) {}

  std::vector<std::string> axes;  ///< as `gyro_axes` has them
};

/// The axes that a recording's gyro has, as `read_recording` takes them: of "x", "y" and "z" those
/// with a column, or "" for `gyro_dps`. Of a text, only its header is read. Throws InputError as
/// `read_recording` does.
std::vector<std::string> gyro_axes(const std::filesystem::path& path,
                                   const RecordingLayout& layout = {});

/// A recording of columns that are in memory, under the names and units that a CSV would have;
/// `place` is what messages call them.
Recording recording_of_columns(ColumnTable columns, const std::string& place,
                               std::string_view axis = "", const RecordingLayout& layout = {},
                               std::span<const std::string_view> wanted = {});

/// Puts a recording on an even clock, as `evenly_sampled` does and `layout.resample_hz` says, and
/// notes what was done.
void make_even(Recording& recording, std::string_view place, const RecordingLayout& layout = {});

/// Throws InputError, naming line and time, when a sampling interval of a series read from `place`,
/// sample 0 from line `first_row` (0: no lines), is more than 10 % off the median interval.
void require_uniform(const Series& series, std::string_view place, std::size_t first_row = 2);

}  // namespace gyrostat
