#include <gyrostat/diagnosis/likelihood/histories/kernels.hpp>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat::gap {

extern const JumpKernel jumps_sse2;
#ifdef GYROSTAT_X86
extern const JumpKernel jumps_avx2;
extern const JumpKernel jumps_avx512;
#endif

const JumpKernel& jump_kernel(std::string_view target) {
#ifdef GYROSTAT_X86
  if (target == targets::Avx512::name) return jumps_avx512;
  if (target == targets::Avx2::name) return jumps_avx2;
#endif
  return jumps_sse2;
}

const JumpKernel& jump_kernel() { return jump_kernel(available_kernels().back()->target); }

}  // namespace gyrostat::gap
