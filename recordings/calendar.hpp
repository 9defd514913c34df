#pragma once

#include <optional>
#include <string_view>

namespace gyrostat {

/// Seconds since 1970-01-01 UTC of a moment as ISO 8601 has it (2026-01-31T23:59:59.25Z, with a
/// blank in place of T, without Z, with an offset as +01:00); nothing where `text` is none. Leap
/// seconds do not count. A microsecond is kept.
std::optional<double> seconds_of_calendar(std::string_view text);

}  // namespace gyrostat
