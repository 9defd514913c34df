#include "core/packed/target.hpp"
#include "experiments/benchmarks/peak.hpp"

namespace gyrostat {

template double multiply_add_peak<targets::Avx512>(std::size_t, double, double);

}  // namespace gyrostat
