#include <gyrostat/recordings/recording_assembly.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/heading_turns.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/channel_values.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat {
namespace {

using Names = std::vector<std::string>;

constexpr std::array<std::string_view, 4> axes = {"", "x", "y", "z"};

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
  const bool is_all = axis == every_axis;
  if (contains(found, axis)) return std::string(axis);
  if (found.empty()) throw_missing(gyro_name(is_all ? "" : axis), unknown, header);
  if (axis.empty() && found.size() == 1) return found.front();
  const auto allowed = found == Names{""} ? "no --axis, for there is one gyro column, gyro_dps"
                                          : fmt::format("'{}'", fmt::join(found, "', '"));
  if (axis.empty() || is_all)
    throw AxisToChoose(header, "one axis is asked for; choose it with --axis " + allowed,
                       std::move(found));
  throw InputError(header, fmt::format("--axis '{}': column '{}' is missing; allowed: {}", axis,
                                       gyro_name(axis), allowed));
}

/// Which axis the gyro turns about: where its column says none, the last that has no column beside
/// it.
std::string_view turned_about(std::string_view axis, const Names& names) {
  if (!axis.empty()) return axis;
  for (const std::string_view other : {"z", "y", "x"})
    if (!contains(names, gyro_name(other))) return other;
  return "";
}

std::string reference_name(std::string_view axis) { return fmt::format("rate_ref_{}_dps", axis); }

/// The column of a channel: of the gyro and of its reference that of its axis, of the rates about
/// the other axes theirs where they have none of their own, by the reference or else by the gyro.
std::string column_of(const Channel& channel, const std::string& axis, const Names& names) {
  if (channel.name == "gyro_dps") return gyro_name(axis);
  const std::size_t steps = channel.name == "cross_rate_1_dps"   ? 1
                            : channel.name == "cross_rate_2_dps" ? 2
                                                                 : 0;
  const bool is_reference = channel.name == "rate_ref_dps";
  const auto about = turned_about(axis, names);
  if ((steps == 0 && !is_reference) || about.empty() || contains(names, channel.name))
    return std::string(channel.name);
  constexpr std::string_view cycle = "xyzxy";
  const auto of_axis = cycle.substr(cycle.find(about) + steps, 1);
  if (const auto reference = reference_name(of_axis); contains(names, reference)) return reference;
  return is_reference ? std::string(channel.name) : gyro_name(of_axis);
}

/// Beyond any doubt, second by second.
bool turns_against_gyro(const Series& series) {
  constexpr double fewest = 20.0, alike = 0.9;
  if (series.heading_deg.empty()) return false;
  const auto together = turns_together(series, unwrapped(series.heading_deg), series.gyro_dps);
  return together.count >= fewest && together.correlation() < -alike;
}

/// Times since 1970 become those since the first sample, which a double holds to the nanosecond.
void count_from_the_first(std::vector<double>& t_s, Recording& recording) {
  constexpr double epoch = 3e8;
  if (t_s.front() < epoch) return;
  recording.notes.push_back(fmt::format("times from {:.6f} s since 1970", t_s.front()));
  const double first = t_s.front();
  for (double& t : t_s) t -= first;
}

}  // namespace

RecordingAssembly::RecordingAssembly(const CsvHeader& header, std::string file,
                                     std::string_view axis, const RecordingLayout& layout,
                                     std::span<const std::string_view> wanted)
    : place_(std::move(file)),
      header_place_(header.line > 0 ? fmt::format("{}:{}", place_, header.line) : place_),
      columns_(under_layout(header.names, header.units, layout, header_place_)),
      rate_hz_(layout.rate_hz) {
  for (const auto& column : columns_) names_.push_back(column.standard);
  recording_.first_row = header.first_row;
  for (const auto& column : columns_)
    if (unknown_columns({column.standard}).empty()) {
      if (column.name != column.standard || column.unit)
        recording_.taken_as.push_back(
            printable(column.name) + " as " + column.standard +
            (column.unit ? fmt::format(" in {}", column.unit->name) : std::string()));
    } else if (!column.name.empty()) {
      recording_.ignored_columns.push_back(printable(column.name));
    }
  if (!contains(names_, "t_s") && rate_hz_ == 0.0)
    throw_missing("t_s", recording_.ignored_columns, header_place_);
  recording_.axis = choose_axis(axis, names_, recording_.ignored_columns, header_place_);
  targets_.resize(names_.size());
  for (const auto& channel : channels) {
    const bool is_wanted = wanted.empty() || channel.name == "gyro_dps" || channel.name == "t_s" ||
                           std::ranges::find(wanted, channel.name) != wanted.end();
    const bool has_clock = channel.name == "t_s" && rate_hz_ > 0.0;
    if (place_of(channel) < names_.size() && is_wanted && !has_clock)
      targets_[place_of(channel)] = &(recording_.series.*channel.values);
  }
  const auto& heading = recording_.series.heading_deg;
  if (std::ranges::find(targets_, &heading) == targets_.end()) return;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (const auto* found = std::ranges::find(field_columns, names_[i]);
        found != field_columns.end())
      targets_[i] = &field_[static_cast<std::size_t>(found - field_columns.begin())];
}

std::size_t RecordingAssembly::place_of(const Channel& channel) const {
  const auto column = std::ranges::find(names_, column_of(channel, recording_.axis, names_));
  return static_cast<std::size_t>(column - names_.begin());
}

Recording RecordingAssembly::finished(bool calendar_times) && {
  auto& series = recording_.series;
  if (series.gyro_dps.empty())
    throw InputError(
        recording_.first_row > 0 ? fmt::format("{}:{}", place_, recording_.first_row) : place_,
        recording_.first_row > 0 ? "no samples below the header; required: at least one"
                                 : "no samples; required: at least one");
  if (rate_hz_ > 0.0) {
    series.t_s.resize(series.gyro_dps.size());
    for (std::size_t i = 0; i < series.t_s.size(); ++i)
      series.t_s[i] = static_cast<double>(i) / rate_hz_;
    recording_.notes.push_back(fmt::format("times are those of {:g} Hz", rate_hz_));
  }
  for (const auto& channel : channels) {
    auto& values = series.*channel.values;
    if (values.empty() || place_of(channel) == names_.size()) continue;
    const bool made = channel.name == "t_s" && rate_hz_ > 0.0;
    if (made) continue;
    auto column = columns_[place_of(channel)];
    if (channel.name == "t_s" && calendar_times) column.unit = nullptr;
    take_channel(values, {channel, column, place_, recording_.first_row});
    if (std::ranges::all_of(values, [](double value) { return std::isnan(value); })) values.clear();
  }
  if (series.gyro_dps.empty())
    throw InputError(header_place_,
                     fmt::format("column '{}' is blank throughout; required: a gyro signal",
                                 gyro_name(recording_.axis)));
  count_from_the_first(series.t_s, recording_);
  if (const auto repeats = leave_out_repeats(series.heading_deg, field_); repeats > 0)
    recording_.notes.push_back(fmt::format(
        "heading_deg: {} values repeat the compass' last reading and are left out", repeats));
  if (turns_against_gyro(series)) {
    for (double& heading : series.heading_deg) heading = wrap_degrees(-heading);
    recording_.notes.emplace_back(
        "heading_deg turns against the gyro, as a clockwise one does beside an axis that points "
        "up: its sign is changed");
  }
  return std::move(recording_);
}

}  // namespace gyrostat
