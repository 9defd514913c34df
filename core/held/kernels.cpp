#include <gyrostat/core/held/kernels.hpp>

#include <span>
#include <string_view>

#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const HoldKernel> holds_sse2;
#ifdef GYROSTAT_X86
extern const std::span<const HoldKernel> holds_avx2;
extern const std::span<const HoldKernel> holds_avx512;
#endif

namespace {

std::span<const HoldKernel> holds_compiled_for(std::string_view target) {
#ifdef GYROSTAT_X86
  if (target == targets::Avx2::name) return holds_avx2;
  if (target == targets::Avx512::name) return holds_avx512;
#endif
  return target == targets::Sse2::name ? holds_sse2 : std::span<const HoldKernel>();
}

}  // namespace

const HoldKernel* hold_kernel(int lanes) {
  const HoldKernel* found = nullptr;
  for (const Kernels* kernels : available_kernels())
    for (const auto& hold : holds_compiled_for(kernels->target))
      if (hold.lanes == lanes) found = &hold;
  return found;
}

}  // namespace gyrostat
