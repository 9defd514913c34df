#include <gyrostat/recordings/recording.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/matlab.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat {
namespace {

using Names = std::vector<std::string>;

struct ChannelRange {
  std::string_view channel;
  double lowest, highest;
  bool whole = false;
};
constexpr std::array channel_ranges = {
    ChannelRange{"gyro_dps", -1e5, 1e5},         ChannelRange{"rate_ref_dps", -1e5, 1e5},
    ChannelRange{"temperature_C", -273.15, 1e3}, ChannelRange{"heading_deg", -180, 180},
    ChannelRange{"mag_valid", 0, 1, true},       ChannelRange{"cross_rate_1_dps", -1e5, 1e5},
    ChannelRange{"cross_rate_2_dps", -1e5, 1e5},
};
constexpr std::array<std::string_view, 4> axes = {"", "x", "y", "z"};
constexpr double largest_interval_error = 0.1;

bool is_nan(double value) { return std::isnan(value); }

std::string gyro_name(std::string_view axis) {
  return axis.empty() ? "gyro_dps" : fmt::format("gyro_{}_dps", axis);
}

bool contains(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

Names unknown_columns(const Names& names) {
  const Names known = standard_columns();
  Names unknown;
  for (const auto& name : names) {
    if (!contains(known, name)) unknown.push_back(printable(name));
  }
  return unknown;
}

[[noreturn]] void throw_missing(std::string_view name, const Names& unknown,
                                std::string_view header) {
  const auto nearest = nearest_name(name, unknown).substr(0, 40);
  throw InputError(header,
                   fmt::format("column '{}' is missing{}; required: t_s and gyro_dps (or"
                               " gyro_x_dps, gyro_y_dps, gyro_z_dps) between commas, semicolons or"
                               " tabs, or --columns t=NAME,gyro=NAME",
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
  const auto allowed = found == Names{""} ? "no --axis, for there is one gyro column, gyro_dps"
                                          : fmt::format("'{}'", fmt::join(found, "', '"));
  throw InputError(header, axis.empty()
                               ? "there are several gyro columns; choose one with --axis " + allowed
                               : fmt::format("--axis '{}': column '{}' is missing; allowed: {}",
                                             axis, gyro_name(axis), allowed));
}

/// The column of a channel: of the gyro that of its axis, of the rates about the other axes theirs
/// where they have none of their own.
std::string column_of(const Channel& channel, const std::string& axis, const Names& names) {
  if (channel.name == "gyro_dps") return gyro_name(axis);
  const std::size_t steps = channel.name == "cross_rate_1_dps"   ? 1
                            : channel.name == "cross_rate_2_dps" ? 2
                                                                 : 0;
  if (steps == 0 || axis.empty() || contains(names, channel.name)) return std::string(channel.name);
  constexpr std::string_view cycle = "xyzxy";
  return gyro_name(cycle.substr(cycle.find(axis) + steps, 1));
}

/// A channel as it stands in the file.
struct Source {
  const Channel& channel;
  const FileColumn& column;
  const std::string& place;
  std::size_t first_row;

  std::string unit() const { return std::string(column.unit ? column.unit->name : channel.unit); }
  std::string name() const { return fmt::format("column '{}'", printable(column.name)); }
  [[noreturn]] void fail(std::ptrdiff_t sample, const std::string& problem) const {
    throw InputError(sample_place(place, first_row, static_cast<std::size_t>(sample)),
                     name() + ": " + problem);
  }
};

void require_increasing(const std::vector<double>& t_s, const Source& source) {
  const auto blank = std::ranges::find_if(t_s, is_nan);
  const auto step = std::ranges::adjacent_find(t_s, std::ranges::greater_equal());
  if (blank != t_s.end())
    source.fail(blank - t_s.begin(), "'' is not a number; allowed: a time in " + source.unit());
  if (step != t_s.end())
    source.fail(
        step - t_s.begin() + 1,
        fmt::format("'{}' does not come after '{}'; allowed: increasing times", step[1], step[0]));
}

/// Values and bounds are in the file's unit.
void require_range(const std::vector<double>& values, const Source& source) {
  const auto range = std::ranges::find(channel_ranges, source.channel.name, &ChannelRange::channel);
  if (range == channel_ranges.end()) return;
  const auto* unit = source.column.unit;
  const double lowest = unit ? unit->from_own(range->lowest) : range->lowest;
  const double highest = unit ? unit->from_own(range->highest) : range->highest;
  const auto wrong = std::ranges::find_if(values, [&](double value) {
    return value < lowest || value > highest ||
           (range->whole && value != std::round(value) && !is_nan(value));
  });
  if (wrong == values.end()) return;
  source.fail(wrong - values.begin(),
              fmt::format("'{}' is out of range; allowed: {}", *wrong,
                          range->whole ? fmt::format("{} or {}", lowest, highest)
                                       : fmt::format("{:.6g} to {:.6g} {}", lowest, highest,
                                                     source.unit())));
}

/// Checks the values of a channel, in the file's unit, and turns them into the program's.
void take_channel(std::vector<double>& values, const Source& source) {
  if (source.channel.name == "t_s") require_increasing(values, source);
  require_range(values, source);
  if (const auto* unit = source.column.unit; unit && !unit->is_own())
    std::ranges::transform(values, values.begin(),
                           [&](double value) { return unit->to_own(value); });
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

namespace {

using Targets = std::vector<std::vector<double>*>;

/// A recording of columns that `read` appends to their targets.
template <class Read>
Recording assemble(const CsvHeader& header, const std::string& place, std::string_view axis,
                   const RecordingLayout& layout, const Read& read) {
  const bool has_lines = header.line > 0;
  const auto header_place = has_lines ? fmt::format("{}:{}", place, header.line) : place;
  const auto columns = under_layout(header.names, header.units, layout, header_place);
  Names names;
  for (const auto& column : columns) names.push_back(column.standard);

  Recording recording;
  recording.first_row = header.first_row;
  for (const auto& column : columns)
    if (unknown_columns({column.standard}).empty()) {
      if (column.name != column.standard || column.unit)
        recording.taken_as.push_back(
            printable(column.name) + " as " + column.standard +
            (column.unit ? fmt::format(" in {}", column.unit->name) : std::string()));
    } else {
      recording.ignored_columns.push_back(printable(column.name));
    }
  if (!contains(names, "t_s")) throw_missing("t_s", recording.ignored_columns, header_place);
  recording.axis = choose_axis(axis, names, recording.ignored_columns, header_place);

  const auto place_in = [&](const Channel& channel) {
    const auto column = std::ranges::find(names, column_of(channel, recording.axis, names));
    return static_cast<std::size_t>(column - names.begin());
  };
  Targets targets(names.size());
  for (const auto& channel : channels)
    if (place_in(channel) < names.size())
      targets[place_in(channel)] = &(recording.series.*channel.values);
  read(targets);

  if (recording.series.t_s.empty())
    throw InputError(has_lines ? fmt::format("{}:{}", place, header.first_row) : place,
                     has_lines ? "no samples below the header; required: at least one"
                               : "no samples; required: at least one");
  for (const auto& channel : channels) {
    if (place_in(channel) == names.size()) continue;
    auto& values = recording.series.*channel.values;
    take_channel(values, {channel, columns[place_in(channel)], place, header.first_row});
    if (std::ranges::all_of(values, is_nan)) values.clear();
  }
  if (recording.series.gyro_dps.empty()) {
    throw InputError(header_place,
                     fmt::format("column '{}' is blank throughout; required: a gyro signal",
                                 gyro_name(recording.axis)));
  }
  return recording;
}

}  // namespace

Recording read_recording(const std::filesystem::path& path, std::string_view axis,
                         const RecordingLayout& layout) {
  const std::string place = path.string();
  if (is_mat_file(path)) {
    MatColumns mat = read_mat(path);
    const CsvHeader header{.names = mat.names, .units = {}, .line = 0, .first_row = 0};
    return assemble(header, place, axis, layout,
                    [&](const Targets& targets) { mat.take(targets, place); });
  }
  const std::string text = read_text(path);
  std::string_view rows = text;
  const auto header = take_header(rows, place);
  return assemble(header, place, axis, layout,
                  [&](const Targets& targets) { read_columns(rows, header, targets, place); });
}

void require_uniform(const Series& series, std::string_view place, std::size_t first_row) {
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
      sample_place(place, first_row, static_cast<std::size_t>(sample)),
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

void write_columns(const std::filesystem::path& path, std::span<const CsvColumn> columns) {
  path.extension() == ".mat" ? write_mat(path, columns) : write_csv(path, columns);
}

void write_series(const std::filesystem::path& path, const Series& series) {
  std::vector<CsvColumn> columns;
  for (const auto& channel : channels) {
    const auto& values = series.*channel.values;
    if (!values.empty()) columns.push_back({std::string(channel.name), values, {}});
  }
  write_columns(path, columns);
}

}  // namespace gyrostat
