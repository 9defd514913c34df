#include <gyrostat/analysis/fits/settled/kernels.hpp>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const SettledKernel settled_sse2;
#ifdef GYROSTAT_X86
extern const SettledKernel settled_avx2;
extern const SettledKernel settled_avx512;
#endif

const SettledKernel& settled_kernel() {
#ifdef GYROSTAT_X86
  const auto widest = available_kernels().back()->target;
  if (widest == targets::Avx512::name) return settled_avx512;
  if (widest == targets::Avx2::name) return settled_avx2;
#endif
  return settled_sse2;
}

}  // namespace gyrostat
