#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/experiments/benchmarks/peak.hpp>
#include <gyrostat/experiments/benchmarks/recursion.hpp>

namespace gyrostat {

template double multiply_add_peak<targets::Avx512>(std::size_t, double, double);
template double recursion<targets::Avx512, filters::Kf, 8>(std::size_t, double);
template double recursion<targets::Avx512, filters::Stf, 8>(std::size_t, double);

}  // namespace gyrostat
