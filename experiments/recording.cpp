#include "experiments/recording.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "experiments/atomic_file.hpp"
#include "experiments/text_input.hpp"

namespace gyrostat {
namespace {

using Names = std::vector<std::string>;

struct Range {
  std::string_view channel;
  double lowest, highest;
  bool whole = false;
};
constexpr std::array ranges = {
    Range{"gyro_dps", -1e5, 1e5},         Range{"rate_ref_dps", -1e5, 1e5},
    Range{"temperature_C", -273.15, 1e3}, Range{"heading_deg", -180, 180},
    Range{"mag_valid", 0, 1, true},
};
constexpr std::array<std::string_view, 4> axes = {"", "x", "y", "z"};
constexpr double largest_interval_error = 0.1;

bool is_nan(double value) { return std::isnan(value); }

/// Sample 0 stands below the header.
std::string at_sample(std::string_view place, std::ptrdiff_t index) {
  return fmt::format("{}:{}", place, index + 2);
}

std::string gyro_name(std::string_view axis) {
  return axis.empty() ? "gyro_dps" : fmt::format("gyro_{}_dps", axis);
}

bool contains(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

Names unknown_columns(const Names& names) {
  Names known;
  for (const auto& channel : channels) known.emplace_back(channel.name);
  for (const auto axis : axes) known.push_back(gyro_name(axis));
  Names unknown;
  for (const auto& name : names) {
    if (!contains(known, name)) unknown.push_back(printable(name));
  }
  return unknown;
}

[[noreturn]] void throw_missing(std::string_view name, const Names& unknown,
                                std::string_view header) {
  const auto nearest = nearest_name(name, unknown).substr(0, 40);
  throw InputError(header, fmt::format("column '{}' is missing{}; required: comma-separated t_s and"
                                       " gyro_dps (or gyro_x_dps, gyro_y_dps, gyro_z_dps)",
                                       name, nearest.empty() ? "" : ", is it '" + nearest + "'?"));
}

std::string choose_axis(std::string_view axis, const Names& names, const Names& unknown,
                        std::string_view header) {
  Names found;
  for (const auto candidate : axes) {
    if (contains(names, gyro_name(candidate))) found.emplace_back(candidate);
  }
  if (contains(found, axis)) return std::string(axis);
  if (found.empty()) throw_missing(gyro_name(axis), unknown, header);
  if (axis.empty() && found.size() == 1) return found.front();
  const auto allowed = fmt::format("'{}'", fmt::join(found, "', '"));
  throw InputError(header, axis.empty()
                               ? "there are several gyro columns; choose one with --axis " + allowed
                               : fmt::format("--axis '{}': column '{}' is missing; allowed: {}",
                                             axis, gyro_name(axis), allowed));
}

void require_increasing(const std::vector<double>& t_s, std::string_view place) {
  const auto blank = std::ranges::find_if(t_s, is_nan);
  const auto step = std::ranges::adjacent_find(t_s, std::ranges::greater_equal());
  if (blank != t_s.end()) {
    throw InputError(at_sample(place, blank - t_s.begin()),
                     "column 't_s': '' is not a number; allowed: a time in s");
  }
  if (step != t_s.end()) {
    throw InputError(at_sample(place, step - t_s.begin() + 1),
                     fmt::format("column 't_s': '{}' does not come after '{}'; allowed:"
                                 " increasing times",
                                 step[1], step[0]));
  }
}

void require_range(const Channel& channel, const std::vector<double>& values,
                   std::string_view column, std::string_view place) {
  const auto range = std::ranges::find(ranges, channel.name, &Range::channel);
  if (range == ranges.end()) return;
  const auto wrong = std::ranges::find_if(values, [&](double value) {
    return value < range->lowest || value > range->highest ||
           (range->whole && value != std::round(value) && !is_nan(value));
  });
  if (wrong == values.end()) return;
  const auto allowed =
      range->whole ? fmt::format("{} or {}", range->lowest, range->highest)
                   : fmt::format("{} to {} {}", range->lowest, range->highest, channel.unit);
  throw InputError(
      at_sample(place, wrong - values.begin()),
      fmt::format("column '{}': '{}' is out of range; allowed: {}", column, *wrong, allowed));
}

std::size_t rows_of(const CsvColumn& column) {
  return column.values.empty() ? column.texts.size() : column.values.size();
}

/// Quoted where RFC 4180 asks for it.
std::string text_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell.append(c == '"' ? 2 : 1, c);
  return cell + '"';
}

}  // namespace

Recording read_recording(const std::filesystem::path& path, std::string_view axis) {
  const std::string place = path.string();
  const std::string text = read_text(path);
  std::string_view rows = text;
  const Names names = take_header(rows, place);
  const std::string header = place + ":1";

  Recording recording;
  recording.ignored_columns = unknown_columns(names);
  if (!contains(names, "t_s")) throw_missing("t_s", recording.ignored_columns, header);
  recording.axis = choose_axis(axis, names, recording.ignored_columns, header);

  const auto column_of = [&](const Channel& channel) {
    return channel.name == "gyro_dps" ? gyro_name(recording.axis) : std::string(channel.name);
  };
  std::vector<std::vector<double>*> targets(names.size());
  for (const auto& channel : channels) {
    const auto column = std::ranges::find(names, column_of(channel));
    if (column == names.end()) continue;
    targets[static_cast<std::size_t>(column - names.begin())] = &(recording.series.*channel.values);
  }
  read_columns(rows, names, targets, place);

  if (recording.series.t_s.empty()) {
    throw InputError(place + ":2", "no samples below the header; required: at least one");
  }
  require_increasing(recording.series.t_s, place);
  for (const auto& channel : channels) {
    auto& values = recording.series.*channel.values;
    require_range(channel, values, column_of(channel), place);
    if (std::ranges::all_of(values, is_nan)) values.clear();
  }
  if (recording.series.gyro_dps.empty()) {
    throw InputError(header, fmt::format("column '{}' is blank throughout; required: a gyro signal",
                                         gyro_name(recording.axis)));
  }
  return recording;
}

void require_uniform(const Series& series, std::string_view place) {
  const auto& t_s = series.t_s;
  if (t_s.size() < 2) return;
  std::vector<double> intervals(t_s.size() - 1);
  std::transform(t_s.begin() + 1, t_s.end(), t_s.begin(), intervals.begin(), std::minus<>());
  auto ordered = intervals;
  const auto middle = ordered.begin() + std::ssize(ordered) / 2;
  std::ranges::nth_element(ordered, middle);
  const auto is_off = [median = *middle](double interval) {
    return std::abs(interval - median) > largest_interval_error * median;
  };
  const auto first = std::ranges::find_if(intervals, is_off);
  if (first == intervals.end()) return;
  const auto sample = first - intervals.begin() + 1;
  throw InputError(
      at_sample(place, sample),
      fmt::format("column 't_s': '{}' comes {:.6g} s after the sample before it; allowed: {:.6g} s,"
                  " the median interval, within {:g} % ({} of {} intervals are not)",
                  t_s[static_cast<std::size_t>(sample)], *first, *middle,
                  100 * largest_interval_error, std::ranges::count_if(intervals, is_off),
                  intervals.size()));
}

void write_csv(const std::filesystem::path& path, std::span<const CsvColumn> columns) {
  const auto separator = [&](const CsvColumn& column) {
    return &column == &columns.back() ? '\n' : ',';
  };
  const std::size_t rows = columns.empty() ? 0 : rows_of(columns.front());
  std::string text;
  for (const auto& column : columns) {
    assert(rows_of(column) == rows);
    text += text_cell(column.name) + separator(column);
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (const auto& column : columns) {
      if (column.values.empty()) {
        text += text_cell(column.texts[row]);
      } else if (!is_nan(column.values[row])) {
        fmt::format_to(std::back_inserter(text), "{:.17g}", column.values[row]);
      }
      text += separator(column);
    }
  }
  write_atomically(path, path.extension() == ".gz" ? gzipped(text) : text);
}

void write_series(const std::filesystem::path& path, const Series& series) {
  std::vector<CsvColumn> columns;
  for (const auto& channel : channels) {
    const auto& values = series.*channel.values;
    if (!values.empty()) columns.push_back({std::string(channel.name), values, {}});
  }
  write_csv(path, columns);
}

}  // namespace gyrostat
