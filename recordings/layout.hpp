#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/recordings/units.hpp>

namespace gyrostat {

/// How a recording that was laid out by others names its columns, and their units. A channel goes
/// by its short name (t, gyro, gyro_x, temp, heading, ...) or by its column's standard name (t_s,
/// ...), a column by its name or its number from 1. A unit of `gyro` or `acc` is that of all three
/// axes where there are three.
struct RecordingLayout {
  std::map<std::string, std::string>
      columns;  ///< channel → column, its unit in brackets where it has one; or number → channel
  std::map<std::string, std::string> units;  ///< channel → unit, whatever the column says
  std::string place = "the recording";       ///< that messages about the layout itself name
  std::string preset{};      ///< the id of the file's format; empty: known by its content
  std::string topic{};       ///< of a log that holds several gyros; empty: the one most often there
  double rate_hz = 0.0;      ///< of the samples, in place of their times; 0: times are in the file
  double resample_hz = 0.0;  ///< of an even clock that samples are put on; 0: as they are
};

/// What `stated` says, and of the rest what `known` does.
RecordingLayout over(const RecordingLayout& stated, const RecordingLayout& known);

/// Both maps from "channel=text,channel=text"; throws InputError at `place`.
std::map<std::string, std::string> parse_assignments(const std::string& text,
                                                     const std::string& place);

/// A column as the file has it, and as the program takes it.
struct FileColumn {
  std::string name;      ///< in the file
  std::string standard;  ///< t_s, gyro_dps, ...; the file's own where the layout does not name it
  const Unit* unit = nullptr;  ///< none: the program's own
};

/// The columns of a file under a layout; `units` are those of the file's own row of units, if any.
/// The unit of a column is the layout's, else that in the layout's brackets, else that in the
/// file's brackets, else that of its row of units, else its suffix ("gyro_z_mdps"), else the
/// program's own; a rate in a column that the layout names must say it. Throws InputError at
/// `header` for columns that are missing, with the nearest name, and for units that are unknown.
std::vector<FileColumn> under_layout(std::span<const std::string> names,
                                     std::span<const std::string> units,
                                     const RecordingLayout& layout, const std::string& header);

/// Of the magnetometer, which tells whether a heading is a new reading.
inline constexpr std::array field_columns = {"mag_x_uT", "mag_y_uT", "mag_z_uT"};

/// Every standard name of a column.
std::vector<std::string> standard_columns();

}  // namespace gyrostat
