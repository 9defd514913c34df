#include <span>

#include <gyrostat/core/held/kernel.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const HoldKernel> holds_avx512;

namespace {
constexpr auto holds = holds_of<targets::Avx512>(targets::Avx512::Lanes{});
}  // namespace

constinit const std::span<const HoldKernel> holds_avx512 = holds;

}  // namespace gyrostat
