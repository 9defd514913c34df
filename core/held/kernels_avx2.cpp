#include <span>

#include <gyrostat/core/held/kernel.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const HoldKernel> holds_avx2;

namespace {
constexpr auto holds = holds_of<targets::Avx2>(targets::Avx2::Lanes{});
}  // namespace

constinit const std::span<const HoldKernel> holds_avx2 = holds;

}  // namespace gyrostat
