#include <span>

#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/generators/packed/kernel.hpp>

namespace gyrostat {

extern const std::span<const SignalKernel> signals_avx2;

namespace {
constexpr auto signals = signals_of<targets::Avx2>(targets::Avx2::Lanes{});
}  // namespace

constinit const std::span<const SignalKernel> signals_avx2 = signals;

}  // namespace gyrostat
