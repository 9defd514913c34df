#include <gyrostat/experiments/run/time_of_day.hpp>

#include <gyrostat/core/error.hpp>

namespace gyrostat {

std::time_t next_time_of_day(const std::string& text, std::time_t now) {
  const auto digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  const bool sound =
      text.size() == 5 && digit(0) && digit(1) && text[2] == ':' && digit(3) && digit(4);
  const int hour = sound ? std::stoi(text.substr(0, 2)) : 24;
  const int minute = sound ? std::stoi(text.substr(3)) : 60;
  if (hour > 23 || minute > 59)
    throw InputError("--until", "'" + text + "' is no time of day; allowed: 00:00 to 23:59");
  std::tm local{};
  localtime_r(&now, &local);
  local.tm_hour = hour;
  local.tm_min = minute;
  local.tm_sec = 0;
  local.tm_isdst = -1;
  const auto today = std::mktime(&local);
  if (today > now) return today;
  ++local.tm_mday;  // mktime carries it over into the next month
  local.tm_isdst = -1;
  return std::mktime(&local);
}

}  // namespace gyrostat
