#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gyrostat {

/// A unit that recordings come in, and its way into the program's own: (value - zero) * times /
/// over.
struct Unit {
  std::string_view name;
  std::string_view
      quantity;  ///< the program's own unit of it: "s", "dps", "°C", "deg", "m/s²", "1"
  double zero = 0.0, times = 1.0, over = 1.0;

  double to_own(double value) const { return (value - zero) * times / over; }
  double from_own(double value) const { return value * over / times + zero; }
  bool is_own() const { return zero == 0.0 && times == over; }
};

/// The unit of `quantity` called `name`, of which there may be several spellings ("us", "µs"), or
/// "lsb/131" for 131 counts to the program's own unit; none where there is no such unit.
const Unit* find_unit(std::string_view name, std::string_view quantity);

/// The same; throws InputError at `place` with the nearest known name.
const Unit& unit_named(std::string_view name, std::string_view quantity, std::string_view place);

/// Whether any quantity has a unit of this name.
bool is_unit(std::string_view name);

/// A column's name and the unit behind it, as in "Time[ms]", "Time (ms)" or "[ms]"; "" where it has
/// none.
std::pair<std::string, std::string> split_unit(std::string_view column);

}  // namespace gyrostat
