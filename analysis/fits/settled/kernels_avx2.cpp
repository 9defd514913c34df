#include <gyrostat/analysis/fits/settled/kernel.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const SettledKernel settled_avx2;

constinit const SettledKernel settled_avx2 = SettledOf<targets::Avx2>::kernel;

}  // namespace gyrostat
