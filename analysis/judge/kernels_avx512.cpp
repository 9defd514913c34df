#include <span>

#include <gyrostat/analysis/judge/kernel.hpp>
#include <gyrostat/core/packed/pack.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const JudgeKernel> judges_avx512;

namespace {
constexpr auto judges = judge::kernels_of<targets::Avx512, Pack>(targets::Avx512::Lanes{});
}  // namespace

constinit const std::span<const JudgeKernel> judges_avx512 = judges;

}  // namespace gyrostat
