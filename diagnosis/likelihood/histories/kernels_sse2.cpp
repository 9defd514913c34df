#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/diagnosis/likelihood/histories/kernel.hpp>

namespace gyrostat::gap {

extern const JumpKernel jumps_sse2;

constinit const JumpKernel jumps_sse2 = {&JumpsOf<targets::Sse2>::follow};

}  // namespace gyrostat::gap
