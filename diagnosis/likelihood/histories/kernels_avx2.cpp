#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/diagnosis/likelihood/histories/kernel.hpp>

namespace gyrostat::gap {

extern const JumpKernel jumps_avx2;

constinit const JumpKernel jumps_avx2 = {&JumpsOf<targets::Avx2>::follow};

}  // namespace gyrostat::gap
