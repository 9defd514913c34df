#include <gyrostat/diagnosis/gap/distinct_values.hpp>

#include <bit>
#include <cstdint>

namespace gyrostat::gap {

std::size_t distinct_values(const std::vector<double>& values) {
  if (values.empty()) return 0;
  // Open addressing at a load of at most a half; no number has the bits of this NaN.
  constexpr auto empty = ~std::uint64_t{0};
  const std::size_t slots = std::bit_ceil(2 * values.size());
  const int shift = 64 - std::countr_zero(slots);
  std::vector<std::uint64_t> table(slots, empty);
  std::size_t distinct = 0;
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);  // -0 is 0
    auto slot = static_cast<std::size_t>((bits * 0x9E3779B97F4A7C15u) >> shift);
    while (table[slot] != empty && table[slot] != bits) slot = (slot + 1) & (slots - 1);
    if (table[slot] == bits) continue;
    table[slot] = bits;
    ++distinct;
  }
  return distinct;
}

}  // namespace gyrostat::gap
