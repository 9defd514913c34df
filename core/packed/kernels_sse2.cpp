#include "core/packed/kernel_table.hpp"
#include "core/packed/target.hpp"

namespace gyrostat {

extern const Kernels kernels_sse2;

namespace {
using Table = KernelTable<targets::Sse2>;
constexpr auto filters_sse2 = Table::of_filters<2, 4, 8>(Filters{});
}  // namespace

constinit const Kernels kernels_sse2{targets::Sse2::name, targets::Sse2::width, filters_sse2,
                                     &Table::normals};

}  // namespace gyrostat
