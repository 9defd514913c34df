#include <gyrostat/recordings/units.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double g_mps2 = 9.80665;  // standard gravity, by definition

/// Spellings of a unit stand together, the one that messages use first.
constexpr std::array units = {
    Unit{"s", "s"},
    Unit{"sec", "s"},
    Unit{"ms", "s", 0, 1, 1e3},
    Unit{"us", "s", 0, 1, 1e6},
    Unit{"\u00b5s", "s", 0, 1, 1e6},  // the micro sign
    Unit{"\u03bcs", "s", 0, 1, 1e6},  // the Greek letter
    Unit{"ns", "s", 0, 1, 1e9},
    Unit{"min", "s", 0, 60},
    Unit{"h", "s", 0, 3600},
    Unit{"dps", "dps"},
    Unit{"deg/s", "dps"},
    Unit{"°/s", "dps"},
    Unit{"deg_s", "dps"},
    Unit{"deg/sec", "dps"},
    Unit{"deg s^-1", "dps"},
    Unit{"mdps", "dps", 0, 1, 1e3},
    Unit{"rad/s", "dps", 0, 180, pi},
    Unit{"rad_s", "dps", 0, 180, pi},
    Unit{"rad/sec", "dps", 0, 180, pi},
    Unit{"rad s^-1", "dps", 0, 180, pi},
    Unit{"rads", "dps", 0, 180, pi},
    Unit{"radps", "dps", 0, 180, pi},
    Unit{"mrad/s", "dps", 0, 0.180, pi},
    Unit{"deg/h", "dps", 0, 1, 3600},
    Unit{"°/h", "dps", 0, 1, 3600},
    Unit{"dph", "dps", 0, 1, 3600},
    Unit{"C", "°C"},
    Unit{"°C", "°C"},
    Unit{"degC", "°C"},
    Unit{"deg C", "°C"},
    Unit{"F", "°C", 32, 5, 9},
    Unit{"°F", "°C", 32, 5, 9},
    Unit{"degF", "°C", 32, 5, 9},
    Unit{"deg F", "°C", 32, 5, 9},
    Unit{"K", "°C", 273.15},
    Unit{"mC", "°C", 0, 1, 1e3},
    Unit{"deg", "deg"},
    Unit{"°", "deg"},
    Unit{"rad", "deg", 0, 180, pi},
    Unit{"m/s²", "m/s²"},
    Unit{"m/s2", "m/s²"},
    Unit{"m/s^2", "m/s²"},
    Unit{"m s^-2", "m/s²"},
    Unit{"mps2", "m/s²"},
    Unit{"g", "m/s²", 0, g_mps2},
    Unit{"mg", "m/s²", 0, g_mps2, 1e3},
    Unit{"1", "1"},
};

/// "lsb/131": counts, so many to the program's own unit. Its name lives as long as the program.
const Unit* count_unit(std::string_view name, std::string_view quantity) {
  constexpr std::string_view begin = "lsb/";
  double counts = 0.0;
  if (!name.starts_with(begin)) return nullptr;
  const auto number = name.substr(begin.size());
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), counts);
  if (error != std::errc() || stop != number.data() + number.size() || !(counts > 0.0) ||
      !std::isfinite(counts))
    return nullptr;
  static std::mutex one_at_a_time;
  static std::map<std::pair<std::string, std::string>, Unit> known;
  const std::lock_guard lock(one_at_a_time);
  const auto [entry, is_new] =
      known.try_emplace({std::string(name), std::string(quantity)}, Unit{"", "", 0, 1, counts});
  if (is_new) entry->second.name = entry->first.first;
  if (is_new) entry->second.quantity = entry->first.second;
  return &entry->second;
}

std::string_view without_blanks(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

const Unit* find_unit(std::string_view name, std::string_view quantity) {
  const auto found = std::ranges::find_if(
      units, [&](const Unit& unit) { return unit.name == name && unit.quantity == quantity; });
  return found == units.end() ? count_unit(name, quantity) : &*found;
}

const Unit& unit_named(std::string_view name, std::string_view quantity, std::string_view place) {
  if (const auto* unit = find_unit(name, quantity)) return *unit;
  std::vector<std::string> names;
  std::string all;
  for (const auto& unit : units)
    if (unit.quantity == quantity) {
      names.emplace_back(unit.name);
      all += (all.empty() ? "" : ", ") + names.back();
    }
  throw InputError(place, unknown_name("unit", name, names) + "; allowed: " + all +
                              ", or lsb/N for N counts to the " + std::string(quantity));
}

bool is_unit(std::string_view name) {
  return std::ranges::find(units, name, &Unit::name) != units.end();
}

std::pair<std::string, std::string> split_unit(std::string_view column) {
  for (const auto brackets : {"[]", "()"}) {
    const auto open = column.rfind(brackets[0]);
    if (open == column.npos || !column.ends_with(brackets[1])) continue;
    const auto unit = column.substr(open + 1, column.size() - open - 2);
    if (unit.starts_with(':')) continue;  // a column of a MATLAB matrix
    return {std::string(without_blanks(column.substr(0, open))), std::string(without_blanks(unit))};
  }
  return {std::string(column), ""};
}

}  // namespace gyrostat
