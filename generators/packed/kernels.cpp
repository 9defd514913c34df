#include <gyrostat/generators/packed/kernels.hpp>

#include <string_view>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const SignalKernel> signals_sse2;
#ifdef GYROSTAT_X86
extern const std::span<const SignalKernel> signals_avx2;
extern const std::span<const SignalKernel> signals_avx512;
#endif

namespace {

std::span<const SignalKernel> compiled_for(std::string_view target) {
#ifdef GYROSTAT_X86
  if (target == targets::Avx2::name) return signals_avx2;
  if (target == targets::Avx512::name) return signals_avx512;
#endif
  return target == targets::Sse2::name ? signals_sse2 : std::span<const SignalKernel>();
}

}  // namespace

const SignalKernel* signal_kernel(int lanes) {
  const SignalKernel* found = nullptr;
  for (const Kernels* kernels : available_kernels())
    for (const auto& signal : compiled_for(kernels->target))
      if (signal.lanes == lanes) found = &signal;
  return found;
}

}  // namespace gyrostat
