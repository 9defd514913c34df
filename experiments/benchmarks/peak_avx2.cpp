#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/experiments/benchmarks/peak.hpp>
#include <gyrostat/experiments/benchmarks/recursion.hpp>

namespace gyrostat {

template double multiply_add_peak<targets::Avx2>(std::size_t, double, double);
template double recursion<targets::Avx2, filters::Kf, 8>(std::size_t, double);
template double recursion<targets::Avx2, filters::Stf, 8>(std::size_t, double);

}  // namespace gyrostat
