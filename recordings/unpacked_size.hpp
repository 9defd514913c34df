#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gyrostat {

/// Refuses what grows without end as it is unpacked, before its memory is taken. `unpacked` bytes
/// have come of `packed` ones so far; `allowed` says what the file at `place` should hold. Numbers
/// as text shrink to a fifth, the same row again and again to a thousandth: up to 64 MiB any ratio
/// will do, from there on a hundred. Throws InputError.
void require_plausible_size(const std::string& place, std::uint64_t packed, std::uint64_t unpacked,
                            std::string_view allowed);

}  // namespace gyrostat
