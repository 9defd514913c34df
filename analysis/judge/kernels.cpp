#include <gyrostat/analysis/judge/kernels.hpp>

#include <map>
#include <span>
#include <string_view>

#include <gyrostat/analysis/judge/kernel.hpp>
#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const JudgeKernel> judges_sse2;
#ifdef GYROSTAT_X86
extern const std::span<const JudgeKernel> judges_avx2;
extern const std::span<const JudgeKernel> judges_avx512;
#endif

namespace {

std::span<const JudgeKernel> compiled_for(std::string_view target) {
#ifdef GYROSTAT_X86
  if (target == targets::Avx2::name) return judges_avx2;
  if (target == targets::Avx512::name) return judges_avx512;
#endif
  return target == targets::Sse2::name ? judges_sse2 : std::span<const JudgeKernel>();
}

}  // namespace

const JudgeKernel* judge_kernel(int lanes) {
  static constexpr JudgeKernel alone = judge::Kernel<double>::all;
  if (lanes == 1) return &alone;
  const JudgeKernel* found = nullptr;
  for (const Kernels* kernels : available_kernels())
    for (const auto& judge : compiled_for(kernels->target))
      if (judge.lanes == lanes) found = &judge;
  return found;
}

}  // namespace gyrostat
