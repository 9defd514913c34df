#include <gyrostat/recordings/layout.hpp>

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat {
namespace {

using Names = std::vector<std::string>;

struct ShortName {
  std::string_view name, standard;
};
constexpr std::array short_names = {
    ShortName{"t", "t_s"},
    ShortName{"time", "t_s"},
    ShortName{"gyro", "gyro_dps"},
    ShortName{"gyro_x", "gyro_x_dps"},
    ShortName{"gyro_y", "gyro_y_dps"},
    ShortName{"gyro_z", "gyro_z_dps"},
    ShortName{"temp", "temperature_C"},
    ShortName{"temperature", "temperature_C"},
    ShortName{"heading", "heading_deg"},
    ShortName{"rate_ref", "rate_ref_dps"},
    ShortName{"rate_ref_x", "rate_ref_x_dps"},
    ShortName{"rate_ref_y", "rate_ref_y_dps"},
    ShortName{"rate_ref_z", "rate_ref_z_dps"},
    ShortName{"acc_x", "acc_x_mps2"},
    ShortName{"acc_y", "acc_y_mps2"},
    ShortName{"acc_z", "acc_z_mps2"},
    ShortName{"cross_rate_1", "cross_rate_1_dps"},
    ShortName{"cross_rate_2", "cross_rate_2_dps"},
    ShortName{"mag_x", "mag_x_uT"},
    ShortName{"mag_y", "mag_y_uT"},
    ShortName{"mag_z", "mag_z_uT"},
};

/// The standard name of the column of a channel.
std::string standard_name(const std::string& channel, const std::string& place) {
  const auto known = standard_columns();
  if (std::ranges::find(known, channel) != known.end()) return channel;
  const auto found = std::ranges::find(short_names, channel, &ShortName::name);
  if (found != short_names.end()) return std::string(found->standard);
  Names names;
  for (const auto& entry : short_names) names.emplace_back(entry.name);
  names.emplace_back("mag_valid");
  throw InputError(place, fmt::format("{}; allowed: {}", unknown_name("channel", channel, names),
                                      fmt::join(names, ", ")));
}

/// The quantity of a standard column.
std::string_view quantity_of(std::string_view standard) {
  if (standard.starts_with("gyro_") || standard.starts_with("rate_ref_")) return "dps";
  const auto channel = std::ranges::find(channels, standard, &Channel::name);
  return channel == channels.end() ? std::string_view() : channel->unit;
}

/// The number that all of `text` is, of at most six digits.
std::optional<std::size_t> number_of(std::string_view text) {
  if (text.empty() || text.size() > 6) return std::nullopt;
  std::size_t number = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    number = 10 * number + static_cast<std::size_t>(c - '0');
  }
  return number;
}

/// Channel → column, of "1=t" as of "t=1".
std::map<std::string, std::string> by_channel(const RecordingLayout& layout) {
  std::map<std::string, std::string> columns;
  for (const auto& [left, right] : layout.columns) {
    const bool turned = number_of(left).has_value();
    if (!columns
             .emplace(turned ? split_unit(right).first : left,
                      turned ? left + right.substr(split_unit(right).first.size()) : right)
             .second)
      throw InputError(layout.place, fmt::format("'{}' stands twice; allowed: once", right));
  }
  return columns;
}

/// The unit that is stated of a column, by the standard name of its channel; taken out of `given`.
std::string take_stated(std::map<std::string, std::string>& given, const FileColumn& column,
                        bool one_gyro) {
  if (const auto own = given.find(column.standard); own != given.end()) {
    auto unit = own->second;
    given.erase(own);
    return unit;
  }
  const bool is_gyro = column.standard.starts_with("gyro_") && !one_gyro;
  const auto all = is_gyro                               ? given.find("gyro_dps")
                   : column.standard.starts_with("acc_") ? given.find("acc")
                                                         : given.end();
  return all == given.end() ? "" : all->second;
}

/// The column that is meant by `wanted`: the very name, or the same name before the unit.
std::size_t find_column(std::span<const std::string> names, const std::string& wanted,
                        const RecordingLayout& layout, const std::string& header) {
  const auto exact = std::ranges::find(names, wanted);
  if (exact != names.end()) return static_cast<std::size_t>(exact - names.begin());
  const auto [base, unit] = split_unit(wanted);
  if (const auto number = number_of(base)) {
    if (*number >= 1 && *number <= names.size()) return *number - 1;
    throw InputError(header, fmt::format("{}: there is no column {}; allowed: 1 to {}",
                                         layout.place, *number, names.size()));
  }
  // A field of a struct goes by its own name, too.
  for (auto dot = wanted.find('.'); dot != wanted.npos; dot = wanted.find('.', dot + 1)) {
    const auto field = std::ranges::find(names, wanted.substr(dot + 1));
    if (field != names.end()) return static_cast<std::size_t>(field - names.begin());
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [other, other_unit] = split_unit(names[i]);
    if (other == base && (unit.empty() || other_unit.empty() || unit == other_unit))
      found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1)
    throw InputError(
        header, fmt::format("{}: '{}' may be column '{}' or '{}'; name one of them", layout.place,
                            wanted, printable(names[found[0]]), printable(names[found[1]])));
  const auto nearest = nearest_name(wanted, Names(names.begin(), names.end()));
  throw InputError(header, fmt::format("{}: column '{}' is missing; is it '{}'?", layout.place,
                                       wanted, printable(nearest)));
}

/// The unit that a name ends in: gyro_z_mdps, time_ms, rate_rad_s.
const Unit* suffix_unit(std::string_view name, std::string_view quantity) {
  for (auto at = name.find('_'); at != name.npos; at = name.find('_', at + 1))
    if (const auto* unit = find_unit(name.substr(at + 1), quantity)) return unit;
  return nullptr;
}

const Unit* unit_of(const FileColumn& column, const std::string& wanted,
                    const std::string& row_unit, const std::string& header) {
  const auto quantity = quantity_of(column.standard);
  const auto place = fmt::format("{}: column '{}'", header, printable(column.name));
  for (const auto& text : {split_unit(wanted).second, split_unit(column.name).second, row_unit})
    if (!text.empty()) return &unit_named(text, quantity, place);
  return suffix_unit(column.name, quantity);
}

}  // namespace

std::vector<std::string> standard_columns() {
  Names names;
  for (const auto& channel : channels) names.emplace_back(channel.name);
  for (const char* of_axis : {"gyro_x_dps", "gyro_y_dps", "gyro_z_dps", "rate_ref_x_dps",
                              "rate_ref_y_dps", "rate_ref_z_dps"})
    names.emplace_back(of_axis);
  names.insert(names.end(), field_columns.begin(), field_columns.end());
  return names;
}

namespace {

/// Where the piece that begins at `begin` ends: at the next comma outside brackets, as in
/// "Gyro(:,3)".
std::size_t piece_end(const std::string& text, std::size_t begin) {
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    depth += text[i] == '(' || text[i] == '[' ? 1 : text[i] == ')' || text[i] == ']' ? -1 : 0;
    if (text[i] == ',' && depth <= 0) return i;
  }
  return text.size();
}

}  // namespace

std::map<std::string, std::string> parse_assignments(const std::string& text,
                                                     const std::string& place) {
  std::map<std::string, std::string> assignments;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = piece_end(text, begin);
    const auto piece = text.substr(begin, end - begin);
    const auto equals = piece.find('=');
    if (equals == 0 || equals == piece.npos || equals + 1 == piece.size())
      throw InputError(place,
                       fmt::format("'{}' is no assignment; allowed: channel=name,channel=name, as "
                                   "t=Time[ms],gyro=GyrZ",
                                   piece));
    if (!assignments.emplace(piece.substr(0, equals), piece.substr(equals + 1)).second)
      throw InputError(place,
                       fmt::format("'{}' stands twice; allowed: once", piece.substr(0, equals)));
    begin = end + 1;
  }
  return assignments;
}

RecordingLayout over(const RecordingLayout& stated, const RecordingLayout& known) {
  RecordingLayout both = stated;
  for (const auto& [channel, column] : known.columns) {
    const bool named = std::ranges::any_of(by_channel(stated), [&](const auto& one) {
      return standard_name(one.first, stated.place) == standard_name(channel, stated.place);
    });
    if (named) continue;
    both.columns[channel] = column;
    if (const auto unit = known.units.find(channel); unit != known.units.end()) {
      const bool own = std::ranges::any_of(stated.units, [&](const auto& one) {
        return one.first == channel || channel.starts_with(one.first + '_');
      });
      if (!own) both.units[channel] = unit->second;
    }
  }
  if (both.rate_hz == 0.0) both.rate_hz = known.rate_hz;
  return both;
}

std::vector<FileColumn> under_layout(std::span<const std::string> names,
                                     std::span<const std::string> units,
                                     const RecordingLayout& layout, const std::string& header) {
  std::vector<FileColumn> columns;
  for (const auto& name : names) columns.push_back({name, name, nullptr});
  Names wanted(names.size());
  for (const auto& [channel, text] : by_channel(layout)) {
    const auto standard = standard_name(channel, layout.place);
    const auto at = find_column(names, text, layout, header);
    for (auto& column : columns)
      if (column.standard == standard) column.standard.clear();  // another column has its place
    columns[at].standard = standard;
    wanted[at] = text;
  }
  std::map<std::string, std::string> given;
  for (const auto& [channel, unit] : layout.units)
    given[channel == "acc" ? channel : standard_name(channel, layout.place)] = unit;
  const bool one_gyro =
      std::ranges::find(columns, "gyro_dps", &FileColumn::standard) != columns.end();
  bool axes = false, accelerations = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    auto& column = columns[i];
    const auto quantity = quantity_of(column.standard);
    if (quantity.empty()) continue;
    axes = axes || (column.standard.starts_with("gyro_") && !one_gyro);
    accelerations = accelerations || column.standard.starts_with("acc_");
    if (const auto stated = take_stated(given, column, one_gyro); !stated.empty())
      column.unit =
          &unit_named(stated, quantity, fmt::format("{}: {}", layout.place, column.standard));
    else if (!wanted[i].empty() || !units.empty())
      column.unit = unit_of(column, wanted[i], i < units.size() ? units[i] : "", header);
    if (quantity == "dps" && !wanted[i].empty() && !column.unit)
      throw InputError(
          header, fmt::format("{}: column '{}' does not say its unit, and a rate in rad/s is 57 "
                              "times one in dps; say --units gyro=rad/s, dps, mdps or lsb/131",
                              layout.place, printable(column.name)));
  }
  if (axes) given.erase("gyro_dps");
  if (accelerations) given.erase("acc");
  if (!given.empty())
    throw InputError(header,
                     fmt::format("{}: a unit for '{}', but there is no such column; allowed: "
                                 "channels that the recording has",
                                 layout.place, given.begin()->first));
  return columns;
}

}  // namespace gyrostat
