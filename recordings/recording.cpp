#include <gyrostat/recordings/recording.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/clock.hpp>
#include <gyrostat/recordings/csv_header.hpp>
#include <gyrostat/recordings/csv_rows.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/input_file.hpp>
#include <gyrostat/recordings/line_blocks.hpp>
#include <gyrostat/recordings/recording_assembly.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;
using Targets = RecordingAssembly::Targets;

constexpr double largest_interval_error = 0.1;

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
  RecordingAssembly assembly(header, file.place(), axis, layout, wanted);
  if (format) assembly.recording().format = format->id;
  reserve_rows(assembly.targets(), lines.empty() ? lines : lines.substr(0, std::size_t{1} << 20),
               std::max<std::uintmax_t>(file.size_hint(), all));
  CsvRows rows(header, assembly.targets(), file.place(), &assembly.recording().series.t_s);
  if (lines.empty()) lines = blocks.next();  // the header filled a block
  for (; !lines.empty(); lines = blocks.next()) {
    rows.feed(lines);
    require_room(assembly.targets(), file.place());
  }
  if (const auto& odd = rows.oddities(); odd.infinite > 0)
    assembly.recording().notes.push_back(
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
  RecordingAssembly assembly(header, place, axis, over(layout, table.layout), wanted);
  table.take(assembly.targets(), place);
  assembly.recording().notes = table.notes;
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

std::vector<std::string> gyro_axes(const fs::path& path, const RecordingLayout& layout) {
  std::vector<std::string> axes;
  try {
    read_recording(path, every_axis, layout);
  } catch (const AxisToChoose& every) {
    axes = every.axes;
  }
  return axes;
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

}  // namespace gyrostat
