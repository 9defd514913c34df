#include <gyrostat/core/packed/normals.hpp>
#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/core/packed/units.hpp>

namespace gyrostat {

extern const Kernels kernels_avx512;

constinit const Kernels kernels_avx512{targets::Avx512::name, targets::Avx512::width,
                                       filters_avx512,
                                       &NormalBlocks<targets::Avx512, normal_blocks>::fill};

}  // namespace gyrostat
