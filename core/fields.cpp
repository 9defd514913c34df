#include <gyrostat/core/fields.hpp>

#include <cmath>
#include <cstdio>

namespace gyrostat {

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  if (open_from ? value <= from : value < from) return false;
  if (open_to ? value >= to : value > to) return false;
  return !whole || value == std::floor(value);
}

std::string Range::to_string() const {
  const bool no_floor = std::isinf(from), no_ceiling = std::isinf(to);
  std::string text = open_from || no_floor ? "(" : "[";
  text += short_number(from) + ", " + short_number(to);
  text += open_to || no_ceiling ? ")" : "]";
  return whole ? text + ", whole numbers" : text;
}

}  // namespace gyrostat
