#include <gyrostat/recordings/format_type.hpp>

#include <algorithm>
#include <array>

namespace gyrostat {

namespace formats {
void append_formats(std::deque<FormatType>& to);
}

bool FormatHead::has(std::string_view column) const {
  return header && std::ranges::find(header->names, column) != header->names.end();
}

std::size_t FormatHead::columns() const { return header ? header->names.size() : 0; }

bool FormatHead::has_all(std::initializer_list<std::string_view> columns) const {
  return std::ranges::all_of(columns, [&](std::string_view column) { return has(column); });
}

void FormatType::describe_all(std::deque<FormatType>& to) { formats::append_formats(to); }

const FormatType* format_of(const FormatHead& head) {
  for (const auto& type : format_types())
    if (type.recognises(head)) return &type;
  return nullptr;
}

std::optional<UnreadableFormat> unreadable_format(const FormatHead& head) {
  struct Known {
    std::string_view magic;
    UnreadableFormat format;
  };
  using namespace std::string_view_literals;
  constexpr std::string_view unpack = "unpack it first";
  static constexpr std::array known = {
      Known{"PAR1"sv,
            {"Apache Parquet",
             "write CSV: python3 -c \"import pandas; "
             "pandas.read_parquet('IN').to_csv('OUT.csv', index=False)\""}},
      Known{"ARROW1"sv,
            {"Apache Arrow (Feather)",
             "write CSV: python3 -c \"import pandas; "
             "pandas.read_feather('IN').to_csv('OUT.csv', index=False)\""}},
      Known{"\x89HDF\r\n\x1a\n"sv,
            {"HDF5",
             "name it .mat where MATLAB wrote it (-v7.3); else write "
             "CSV, as by h5dump or h5py"}},
      Known{"#ROSBAG V1"sv, {"ROS bag of version 1", "rosbag fix IN.bag OUT.bag"}},
      Known{"\x28\xb5\x2f\xfd"sv, {"Zstandard", "unpack it first: zstd -d FILE"}},
      Known{"\x04\x22\x4d\x18"sv, {"LZ4", "unpack it first: lz4 -d FILE"}},
      Known{"BZh"sv, {"bzip2", "unpack it first: bunzip2 FILE"}},
      Known{"\xfd"
            "7zXZ\0"sv,
            {"xz", "unpack it first: unxz FILE"}},
      Known{"7z\xbc\xaf"sv, {"7-Zip", unpack}},
      Known{"Rar!"sv, {"RAR", unpack}},
      Known{"PK\x03\x04"sv,
            {"a ZIP archive (as phone loggers, Excel and NumPy write)",
             "unzip it and name the gyroscope's file, or save the sheet as CSV"}},
      Known{"\xd0\xcf\x11\xe0"sv, {"Excel", "save the sheet as CSV"}},
      Known{"SQLite format 3\0"sv,
            {"an SQLite database that is no rosbag2",
             "write CSV: sqlite3 -csv -header FILE 'SELECT …'"}},
      Known{"\x80\x02"sv, {"a Python pickle", "write CSV, or numpy.save"}},
      Known{"\x80\x03"sv, {"a Python pickle", "write CSV, or numpy.save"}},
      Known{"\x80\x04"sv, {"a Python pickle", "write CSV, or numpy.save"}},
      Known{"\x80\x05"sv, {"a Python pickle", "write CSV, or numpy.save"}},
      Known{"\xfa\xff"sv, {"Xsens MTB", "export it as text by MT Manager"}},
      Known{"TDSm"sv, {"LabVIEW TDMS", "write CSV, as by nptdms"}},
      Known{"{"sv, {"JSON", "write CSV: a header, then one row a sample"}},
      Known{"["sv, {"JSON", "write CSV: a header, then one row a sample"}},
      Known{"<?xml"sv, {"XML", "write CSV: a header, then one row a sample"}},
  };
  for (const auto& [magic, format] : known)
    if (head.starts_with(magic)) return format;
  if (head.bytes.size() > 12 && head.bytes.substr(8, 4) == ".FIT")
    return UnreadableFormat{"Garmin FIT", "write CSV by FitCSVTool"};
  return std::nullopt;
}

}  // namespace gyrostat
