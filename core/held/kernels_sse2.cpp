#include <span>

#include <gyrostat/core/held/kernel.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const HoldKernel> holds_sse2;

namespace {
constexpr auto holds = holds_of<targets::Sse2>(targets::Sse2::Lanes{});
}  // namespace

constinit const std::span<const HoldKernel> holds_sse2 = holds;

}  // namespace gyrostat
