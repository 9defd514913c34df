#include <gyrostat/recordings/unpacked_size.hpp>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat {

void require_plausible_size(const std::string& place, std::uint64_t packed, std::uint64_t unpacked,
                            std::string_view allowed) {
  constexpr std::uint64_t largest_ratio = 100, free_bytes = std::uint64_t{1} << 26;
  if (unpacked > free_bytes && unpacked > largest_ratio * packed)
    throw InputError(place, fmt::format("unpacks to more than {} times its size; allowed: {}",
                                        largest_ratio, allowed));
}

}  // namespace gyrostat
