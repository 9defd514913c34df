#pragma once

#include <ctime>
#include <string>

namespace gyrostat {

/// The next time after `now` at which a local clock shows `text`, "07:00"; throws InputError where
/// that is no time of day.
std::time_t next_time_of_day(const std::string& text, std::time_t now);

}  // namespace gyrostat
