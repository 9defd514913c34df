#include <gyrostat/core/packed/normals.hpp>
#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/core/packed/units.hpp>

namespace gyrostat {

extern const Kernels kernels_sse2;

constinit const Kernels kernels_sse2{targets::Sse2::name, targets::Sse2::width, filters_sse2,
                                     &NormalBlocks<targets::Sse2, normal_blocks>::fill};

}  // namespace gyrostat
