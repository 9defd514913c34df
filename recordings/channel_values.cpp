#include <gyrostat/recordings/channel_values.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat {
namespace {

struct ChannelRange {
  std::string_view channel;
  double lowest, highest;
  bool whole = false;
};
constexpr std::array channel_ranges = {
    ChannelRange{"gyro_dps", -1e5, 1e5},         ChannelRange{"rate_ref_dps", -1e5, 1e5},
    ChannelRange{"temperature_C", -273.15, 1e3}, ChannelRange{"heading_deg", -180, 360},
    ChannelRange{"mag_valid", 0, 1, true},       ChannelRange{"cross_rate_1_dps", -1e5, 1e5},
    ChannelRange{"cross_rate_2_dps", -1e5, 1e5},
};

std::string unit_of(const ChannelSource& source) {
  return std::string(source.column.unit ? source.column.unit->name : source.channel.unit);
}

[[noreturn]] void fail(const ChannelSource& source, std::ptrdiff_t sample,
                       const std::string& problem) {
  throw InputError(sample_place(source.place, source.first_row, static_cast<std::size_t>(sample)),
                   fmt::format("column '{}': {}", printable(source.column.name), problem));
}

void require_increasing(const std::vector<double>& t_s, const ChannelSource& source) {
  const auto blank = std::ranges::find_if(t_s, [](double t) { return std::isnan(t); });
  const auto step = std::ranges::adjacent_find(t_s, std::ranges::greater_equal());
  if (blank != t_s.end())
    fail(source, blank - t_s.begin(), "'' is not a number; allowed: a time in " + unit_of(source));
  if (step != t_s.end())
    fail(source, step - t_s.begin() + 1,
         fmt::format("'{}' does not come after '{}'; allowed: increasing times (--rate HZ does "
                     "without them)",
                     step[1], step[0]));
}

/// Values and bounds are in the file's unit.
void require_range(const std::vector<double>& values, const ChannelSource& source) {
  const auto range = std::ranges::find(channel_ranges, source.channel.name, &ChannelRange::channel);
  if (range == channel_ranges.end()) return;
  const auto* unit = source.column.unit;
  const double lowest = unit ? unit->from_own(range->lowest) : range->lowest;
  const double highest = unit ? unit->from_own(range->highest) : range->highest;
  constexpr double written = 1e-4;  // radians of four decimals are written up to 3.1416
  const auto wrong = std::ranges::find_if(values, [&](double value) {
    return value < lowest - written * std::abs(lowest) ||
           value > highest + written * std::abs(highest) ||
           (range->whole && value != std::round(value) && !std::isnan(value));
  });
  if (wrong == values.end()) return;
  fail(source, wrong - values.begin(),
       fmt::format("'{}' is out of range; allowed: {}", *wrong,
                   range->whole
                       ? fmt::format("{} or {}", lowest, highest)
                       : fmt::format("{:.6g} to {:.6g} {}", lowest, highest, unit_of(source))));
}

}  // namespace

void take_channel(std::vector<double>& values, const ChannelSource& source) {
  if (source.channel.name == "t_s") require_increasing(values, source);
  require_range(values, source);
  if (const auto* unit = source.column.unit; unit && !unit->is_own())
    std::ranges::transform(values, values.begin(),
                           [&](double value) { return unit->to_own(value); });
  if (source.channel.name == "heading_deg")
    std::ranges::transform(values, values.begin(), wrap_degrees<double>);
}

}  // namespace gyrostat
