#pragma once

#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <gyrostat/core/series.hpp>

namespace gyrostat::cli {

/// A span of the recording, in seconds from its first sample, and what of it does not count.
struct SpanOption {
  double from_s = 0.0;
  double to_s = 1e12;
  std::vector<std::string> left_out;  ///< FROM:TO each

  void add_to(CLI::App* verb);
  bool is_part_of(const Series& series) const {
    return from_s > 0.0 || to_s <= series.duration_s();
  }
  /// Makes the gyro of the file missing there. Throws InputError where there are no samples.
  void leave_out(Series& series, const std::string& file) const;
};

}  // namespace gyrostat::cli
