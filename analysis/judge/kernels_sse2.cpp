#include <span>

#include <gyrostat/analysis/judge/kernel.hpp>
#include <gyrostat/core/packed/pack.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const JudgeKernel> judges_sse2;

namespace {
constexpr auto judges = judge::kernels_of<targets::Sse2, Pack>(targets::Sse2::Lanes{});
}  // namespace

constinit const std::span<const JudgeKernel> judges_sse2 = judges;

}  // namespace gyrostat
