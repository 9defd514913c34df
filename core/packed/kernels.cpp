#include <gyrostat/core/packed/kernels.hpp>

#include <array>

namespace gyrostat {

extern const Kernels kernels_sse2;
#ifdef GYROSTAT_X86
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;
#endif

namespace {

struct Available {
  std::array<const Kernels*, 3> kernels{&kernels_sse2};
  std::size_t count = 1;

  Available() {
#ifdef GYROSTAT_X86
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) kernels[count++] = &kernels_avx2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
      kernels[count++] = &kernels_avx512;
#endif
  }
};

}  // namespace

std::span<const Kernels* const> available_kernels() {
  static const Available available;
  return {available.kernels.data(), available.count};
}

const PackedFilter* packed_filter(std::string_view filter, int lanes) {
  const PackedFilter* found = nullptr;
  for (const Kernels* kernels : available_kernels())
    for (const auto* unit : kernels->filters)
      for (const auto& candidate : *unit)
        if (candidate.filter == filter && candidate.lanes == lanes) found = &candidate;
  return found;
}

}  // namespace gyrostat
