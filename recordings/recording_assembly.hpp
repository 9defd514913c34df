#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/recordings/csv_header.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/recordings/repeated_heading.hpp>

namespace gyrostat {

/// The columns of a file, under a layout, and where their values go.
class RecordingAssembly {
 public:
  using Targets = std::vector<std::vector<double>*>;

  /// Of columns called so in the file; `line` of the header, 0 where there are no lines. Throws
  /// InputError where a column that must be there is not, with the nearest name.
  RecordingAssembly(const CsvHeader& header, std::string file, std::string_view axis,
                    const RecordingLayout& layout, std::span<const std::string_view> wanted);
  RecordingAssembly(const RecordingAssembly&) = delete;  // the targets are in it
  RecordingAssembly& operator=(const RecordingAssembly&) = delete;

  Recording& recording() { return recording_; }
  /// One for each column of the file; nullptr where nobody wants it.
  const Targets& targets() const { return targets_; }

  /// Checks and converts what the targets were given.
  Recording finished(bool calendar_times = false) &&;

 private:
  std::size_t place_of(const Channel& channel) const;

  std::string place_, header_place_;
  std::vector<FileColumn> columns_;
  std::vector<std::string> names_;  ///< standard ones
  Recording recording_;
  MagneticField field_;
  Targets targets_;
  double rate_hz_;
};

}  // namespace gyrostat
