#include <gyrostat/analysis/fits/settled/kernel.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const SettledKernel settled_sse2;

constinit const SettledKernel settled_sse2 = SettledOf<targets::Sse2>::kernel;

}  // namespace gyrostat
