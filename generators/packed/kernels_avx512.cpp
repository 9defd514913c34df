#include <span>

#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/generators/packed/kernel.hpp>

namespace gyrostat {

extern const std::span<const SignalKernel> signals_avx512;

namespace {
constexpr auto signals = signals_of<targets::Avx512>(targets::Avx512::Lanes{});
}  // namespace

constinit const std::span<const SignalKernel> signals_avx512 = signals;

}  // namespace gyrostat
