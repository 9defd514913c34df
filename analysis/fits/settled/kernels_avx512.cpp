#include <gyrostat/analysis/fits/settled/kernel.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const SettledKernel settled_avx512;

constinit const SettledKernel settled_avx512 = SettledOf<targets::Avx512>::kernel;

}  // namespace gyrostat
