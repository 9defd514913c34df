#include <gyrostat/core/packed/normals.hpp>
#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/core/packed/units.hpp>

namespace gyrostat {

extern const Kernels kernels_avx2;

constinit const Kernels kernels_avx2{targets::Avx2::name, targets::Avx2::width, filters_avx2,
                                     &NormalBlocks<targets::Avx2, normal_blocks>::fill};

}  // namespace gyrostat
