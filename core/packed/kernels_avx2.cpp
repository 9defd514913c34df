#include "core/packed/kernel_table.hpp"
#include "core/packed/target.hpp"

namespace gyrostat {

extern const Kernels kernels_avx2;

namespace {
using Table = KernelTable<targets::Avx2>;
constexpr auto filters_avx2 = Table::of_filters<4, 8>(Filters{});
}  // namespace

constinit const Kernels kernels_avx2{targets::Avx2::name, targets::Avx2::width, filters_avx2,
                                     &Table::normals};

}  // namespace gyrostat
