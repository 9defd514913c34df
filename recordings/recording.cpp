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
#include <gyrostat/recordings/clock.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/input_file.hpp>
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
                               " tabs, or --columns t=NAME,gyro=NAME{}",
                               name, nearest.empty() ? "" : ", is it '" + nearest + "'?",
                               name == "t_s" ? ", or --rate HZ where there are no times" : ""));
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

namespace fs = std::filesystem;
using Targets = std::vector<std::vector<double>*>;

/// The columns of a file, under a layout, and where their values go.
struct Assembly {
  std::string place, header_place;
  std::vector<FileColumn> columns;
  Names names;  ///< standard ones
  Recording recording;
  Targets targets;
  double rate_hz;

  /// Of columns called so in the file; `line` of the header, 0 where there are no lines.
  Assembly(const CsvHeader& header, std::string file, std::string_view axis,
           const RecordingLayout& layout, std::span<const std::string_view> wanted)
      : place(std::move(file)),
        header_place(header.line > 0 ? fmt::format("{}:{}", place, header.line) : place),
        columns(under_layout(header.names, header.units, layout, header_place)),
        rate_hz(layout.rate_hz) {
    for (const auto& column : columns) names.push_back(column.standard);
    recording.first_row = header.first_row;
    for (const auto& column : columns)
      if (unknown_columns({column.standard}).empty()) {
        if (column.name != column.standard || column.unit)
          recording.taken_as.push_back(
              printable(column.name) + " as " + column.standard +
              (column.unit ? fmt::format(" in {}", column.unit->name) : std::string()));
      } else if (!column.name.empty()) {
        recording.ignored_columns.push_back(printable(column.name));
      }
    if (!contains(names, "t_s") && rate_hz == 0.0)
      throw_missing("t_s", recording.ignored_columns, header_place);
    recording.axis = choose_axis(axis, names, recording.ignored_columns, header_place);
    targets.resize(names.size());
    for (const auto& channel : channels) {
      const bool is_wanted = wanted.empty() || channel.name == "gyro_dps" ||
                             channel.name == "t_s" ||
                             std::ranges::find(wanted, channel.name) != wanted.end();
      const bool has_clock = channel.name == "t_s" && rate_hz > 0.0;
      if (place_of(channel) < names.size() && is_wanted && !has_clock)
        targets[place_of(channel)] = &(recording.series.*channel.values);
    }
  }
  Assembly(const Assembly&) = delete;  // the targets are in it
  Assembly& operator=(const Assembly&) = delete;

  std::size_t place_of(const Channel& channel) const {
    const auto column = std::ranges::find(names, column_of(channel, recording.axis, names));
    return static_cast<std::size_t>(column - names.begin());
  }

  /// Checks and converts what the targets were given.
  Recording finished(bool calendar_times = false) && {
    auto& series = recording.series;
    if (series.gyro_dps.empty())
      throw InputError(
          recording.first_row > 0 ? fmt::format("{}:{}", place, recording.first_row) : place,
          recording.first_row > 0 ? "no samples below the header; required: at least one"
                                  : "no samples; required: at least one");
    if (rate_hz > 0.0) {
      series.t_s.resize(series.gyro_dps.size());
      for (std::size_t i = 0; i < series.t_s.size(); ++i)
        series.t_s[i] = static_cast<double>(i) / rate_hz;
      recording.notes.push_back(fmt::format("times are those of {:g} Hz", rate_hz));
    }
    for (const auto& channel : channels) {
      auto& values = series.*channel.values;
      if (values.empty() || place_of(channel) == names.size()) continue;
      const bool made = channel.name == "t_s" && rate_hz > 0.0;
      if (made) continue;
      auto column = columns[place_of(channel)];
      if (channel.name == "t_s" && calendar_times) column.unit = nullptr;
      take_channel(values, {channel, column, place, recording.first_row});
      if (std::ranges::all_of(values, is_nan)) values.clear();
    }
    if (series.gyro_dps.empty())
      throw InputError(header_place,
                       fmt::format("column '{}' is blank throughout; required: a gyro signal",
                                   gyro_name(recording.axis)));
    from_the_first(series.t_s);
    return std::move(recording);
  }

  /// Times since 1970 become those since the first sample, which a double holds to the nanosecond.
  void from_the_first(std::vector<double>& t_s) {
    constexpr double epoch = 3e8;
    if (t_s.front() < epoch) return;
    recording.notes.push_back(fmt::format("times from {:.6f} s since 1970", t_s.front()));
    const double first = t_s.front();
    for (double& t : t_s) t -= first;
  }
};

/// Room for about as many rows as the file has.
void reserve_rows(const Targets& targets, std::string_view block, std::uintmax_t bytes) {
  constexpr std::size_t most = std::size_t{1} << 27;
  const auto lines = static_cast<double>(std::count(block.begin(), block.end(), '\n') + 1);
  const double rows =
      block.empty() ? 0.0
                    : 1.02 * lines * static_cast<double>(bytes) / static_cast<double>(block.size());
  for (auto* target : targets)
    if (target) target->reserve(std::min(most, static_cast<std::size_t>(rows) + 16));
}

/// More than that is no recording that fits: two columns of a day at 1 kHz are 170 million values.
void require_room(const Targets& targets, const std::string& place) {
  constexpr std::size_t most_values = std::size_t{1} << 29;
  std::size_t values = 0;
  for (const auto* target : targets) values += target ? target->size() : 0;
  if (values > most_values)
    throw InputError(place, fmt::format("holds more than {} million values; cut it into parts",
                                        most_values / 1'000'000));
}

Recording recording_of_text(InputFile& file, FormatHead& head, const FormatType* format,
                            std::string_view axis, const RecordingLayout& stated,
                            std::span<const std::string_view> wanted) {
  LineBlocks blocks(file);
  auto lines = blocks.next();
  if (lines.empty())
    throw InputError(file.place(), "is empty; allowed: a header and at least one sample");
  const auto all = lines.size();
  const auto header = take_header(lines, file.place());
  head.header = &header;
  if (!format) format = format_of(head);
  if (format && format->read) {
    InputFile again(file.path());  // it reads the text itself
    auto recording =
        recording_of_columns(format->read({file.path(), file.place(), &again, stated.topic}),
                             file.place(), axis, stated, wanted);
    recording.format = format->id;
    return recording;
  }
  const auto layout = format ? over(stated, format->layout(head)) : stated;
  Assembly assembly(header, file.place(), axis, layout, wanted);
  if (format) assembly.recording.format = format->id;
  reserve_rows(assembly.targets, lines.empty() ? lines : lines.substr(0, std::size_t{1} << 20),
               std::max<std::uintmax_t>(file.size_hint(), all));
  CsvRows rows(header, assembly.targets, file.place(), &assembly.recording.series.t_s);
  if (lines.empty()) lines = blocks.next();  // the header filled a block
  for (; !lines.empty(); lines = blocks.next()) {
    rows.feed(lines);
    require_room(assembly.targets, file.place());
  }
  if (const auto& odd = rows.oddities(); odd.infinite > 0)
    assembly.recording.notes.push_back(
        fmt::format("{} infinite value{} taken as missing, the first in line {}", odd.infinite,
                    odd.infinite == 1 ? "" : "s", odd.infinite_line));
  return std::move(assembly).finished(rows.oddities().calendar_times);
}

/// The one file of a folder that rosbag2 wrote.
fs::path in_folder(const fs::path& path) {
  std::error_code unknown;
  if (path == "-" || !fs::is_directory(path, unknown)) return path;
  std::vector<fs::path> bags;
  for (const auto& entry : fs::directory_iterator(path, unknown))
    if (entry.path().extension() == ".mcap" || entry.path().extension() == ".db3")
      bags.push_back(entry.path());
  if (bags.size() > 1)
    throw InputError(path.string(), fmt::format("holds {} bags; name one, as {}", bags.size(),
                                                std::ranges::min(bags).string()));
  return bags.empty() ? path : bags.front();
}

}  // namespace

Recording recording_of_columns(ColumnTable table, const std::string& place, std::string_view axis,
                               const RecordingLayout& layout,
                               std::span<const std::string_view> wanted) {
  const CsvHeader header{.names = table.names, .units = {}, .line = 0, .first_row = 0};
  Assembly assembly(header, place, axis, over(layout, table.layout), wanted);
  table.take(assembly.targets, place);
  assembly.recording.notes = table.notes;
  return std::move(assembly).finished();
}

Recording read_recording(const fs::path& named, std::string_view axis,
                         const RecordingLayout& layout, std::span<const std::string_view> wanted) {
  const auto path = in_folder(named);
  const auto* format = layout.preset.empty() || layout.preset == "csv"
                           ? nullptr
                           : &format_types().named(layout.preset, layout.place);
  FormatHead head{path, {}, nullptr};
  std::error_code unknown;
  if (path != "-" && fs::is_directory(path, unknown)) {
    if (!format) format = format_of(head);
    if (!format || !format->read || !format->recognises(head))
      throw InputError(path.string(),
                       "is a directory; allowed: a file, or a folder as KITTI's oxts "
                       "or a bag of rosbag2");
    auto recording =
        recording_of_columns(format->read({path, path.string(), nullptr, layout.topic}),
                             path.string(), axis, layout, wanted);
    recording.format = format->id;
    return recording;
  }
  InputFile file(path);
  head.bytes = file.head();
  if (!format && layout.preset.empty()) format = format_of(head);
  if (format && format->read && format->recognises(head)) {
    auto recording = recording_of_columns(format->read({path, file.place(), &file, layout.topic}),
                                          file.place(), axis, layout, wanted);
    recording.format = format->id;
    return recording;
  }
  if (const auto unreadable = unreadable_format(head))
    throw InputError(file.place(), fmt::format("is {}, which cannot be read; {}", unreadable->name,
                                               unreadable->remedy));
  return recording_of_text(file, head, format, axis, layout, wanted);
}

void make_even(Recording& recording, std::string_view place, const RecordingLayout& layout) {
  auto even =
      evenly_sampled(std::move(recording.series), place, recording.first_row, layout.resample_hz);
  recording.series = std::move(even.series);
  if (even.note.empty()) return;
  recording.notes.push_back(std::move(even.note));
  recording.first_row = 0;  // samples and lines no longer go together
}

void require_uniform(const Series& series, std::string_view place, std::size_t first_row) {
  const auto& t_s = series.t_s;
  if (t_s.size() < 2 || is_even(t_s)) return;
  const double median = median_interval(t_s);
  const auto is_off = [&](std::size_t i) {
    return std::abs(t_s[i] - t_s[i - 1] - median) > largest_interval_error * median;
  };
  std::size_t first = 0, count = 0;
  for (std::size_t i = 1; i < t_s.size(); ++i)
    if (is_off(i) && count++ == 0) first = i;
  throw InputError(
      sample_place(place, first_row, first),
      fmt::format("column 't_s': '{}' comes {:.6g} s after the sample before it; allowed: {:.6g} s,"
                  " the median interval, within {:g} % ({} of {} intervals are not)",
                  t_s[first], t_s[first] - t_s[first - 1], median, 100 * largest_interval_error,
                  count, t_s.size() - 1));
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
