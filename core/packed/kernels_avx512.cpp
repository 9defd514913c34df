#include "core/packed/kernel_table.hpp"
#include "core/packed/target.hpp"

namespace gyrostat {

extern const Kernels kernels_avx512;

namespace {
using Table = KernelTable<targets::Avx512>;
constexpr auto filters_avx512 = Table::of_filters<8, 16>(Filters{});
}  // namespace

constinit const Kernels kernels_avx512{targets::Avx512::name, targets::Avx512::width,
                                       filters_avx512, &Table::normals};

}  // namespace gyrostat
