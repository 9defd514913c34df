#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>
#include <gyrostat/recordings/layout.hpp>

namespace gyrostat {

/// A channel as it stands in the file.
struct ChannelSource {
  const Channel& channel;
  const FileColumn& column;
  const std::string& place;
  std::size_t first_row;
};

/// Checks the values of a channel, in the file's unit, and turns them into the program's. Throws
/// InputError naming place, column, value and what is allowed.
void take_channel(std::vector<double>& values, const ChannelSource& source);

}  // namespace gyrostat
