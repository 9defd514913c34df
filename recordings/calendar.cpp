#include <gyrostat/recordings/calendar.hpp>

#include <charconv>
#include <chrono>

namespace gyrostat {
namespace {

/// Cuts a number of exactly `digits` digits off the front; -1 where there is none.
int take_digits(std::string_view& text, std::size_t digits) {
  int value = -1;
  if (text.size() < digits) return -1;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + digits, value);
  if (error != std::errc() || stop != text.data() + digits || value < 0) return -1;
  text.remove_prefix(digits);
  return value;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == any_of.npos) return false;
  text.remove_prefix(1);
  return true;
}

/// A fraction ".25" off the front; 0 where there is none.
double take_fraction(std::string_view& text) {
  if (text.size() < 2 || (text[0] != '.' && text[0] != ',') || text[1] < '0' || text[1] > '9')
    return 0.0;
  text.remove_prefix(1);
  double value = 0.0, scale = 1.0;
  for (; !text.empty() && text.front() >= '0' && text.front() <= '9'; text.remove_prefix(1)) {
    value = 10.0 * value + (text.front() - '0');
    scale *= 10.0;
  }
  return value / scale;
}

/// Seconds east of UTC: Z, +01:00, -0530, or nothing for UTC.
std::optional<int> take_offset(std::string_view& text) {
  if (text.empty() || take(text, "Zz")) return 0;
  const int sign = text.front() == '-' ? -1 : 1;
  if (!take(text, "+-")) return std::nullopt;
  const int hours = take_digits(text, 2);
  (void)take(text, ":");
  const int minutes = text.empty() ? 0 : take_digits(text, 2);
  if (hours < 0 || minutes < 0) return std::nullopt;
  return sign * (3600 * hours + 60 * minutes);
}

}  // namespace

std::optional<double> seconds_of_calendar(std::string_view text) {
  using namespace std::chrono;
  if (text.size() < 10 || text[4] != text[7] || (text[4] != '-' && text[4] != '/'))
    return std::nullopt;
  const int y = take_digits(text, 4);
  (void)take(text, "-/");
  const int m = take_digits(text, 2);
  (void)take(text, "-/");
  const int d = take_digits(text, 2);
  const year_month_day date{year{y}, month{static_cast<unsigned>(m)},
                            day{static_cast<unsigned>(d)}};
  if (y < 0 || m < 0 || d < 0 || !date.ok()) return std::nullopt;
  if (!take(text, "T t_")) return std::nullopt;
  const int h = take_digits(text, 2);
  const bool has_minutes = take(text, ":");
  const int min = take_digits(text, 2);
  const bool has_seconds = take(text, ":");
  const int s = has_seconds ? take_digits(text, 2) : 0;
  if (!has_minutes || h < 0 || h > 24 || min < 0 || min > 59 || s < 0 || s > 60)
    return std::nullopt;
  const double fraction = take_fraction(text);
  while (take(text, " ")) {
  }
  const auto offset = take_offset(text);
  if (!offset || !text.empty()) return std::nullopt;
  const auto days = sys_days{date}.time_since_epoch().count();
  return static_cast<double>(days * 86400LL + h * 3600 + min * 60 + s - *offset) + fraction;
}

}  // namespace gyrostat
