#pragma once

#include <string_view>
#include <utility>

namespace gyrostat::targets {

/// An instruction set that kernels are compiled for: how many doubles its registers hold, and the
/// sizes of packs that filters are compiled in. A type of its own for each, so that no function
/// compiled for one is mistaken for another's.
struct Sse2 {
  static constexpr std::string_view name = "SSE2";
  static constexpr int width = 2;
  using Lanes = std::integer_sequence<int, 2>;
};
struct Avx2 {
  static constexpr std::string_view name = "AVX2";
  static constexpr int width = 4;
  using Lanes = std::integer_sequence<int, 4, 8>;
};
struct Avx512 {
  static constexpr std::string_view name = "AVX-512";
  static constexpr int width = 8;
  using Lanes = std::integer_sequence<int, 8, 16>;
};

}  // namespace gyrostat::targets
