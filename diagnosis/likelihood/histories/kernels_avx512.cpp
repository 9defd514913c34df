#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/diagnosis/likelihood/histories/kernel.hpp>

namespace gyrostat::gap {

extern const JumpKernel jumps_avx512;

constinit const JumpKernel jumps_avx512 = {&JumpsOf<targets::Avx512>::follow};

}  // namespace gyrostat::gap
