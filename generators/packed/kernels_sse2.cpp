#include <span>

#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/generators/packed/kernel.hpp>

namespace gyrostat {

extern const std::span<const SignalKernel> signals_sse2;

namespace {
constexpr auto signals = signals_of<targets::Sse2>(targets::Sse2::Lanes{});
}  // namespace

constinit const std::span<const SignalKernel> signals_sse2 = signals;

}  // namespace gyrostat
