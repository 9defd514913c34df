#pragma once

#include <string_view>

namespace gyrostat::targets {

/// An instruction set that kernels are compiled for: how many doubles its registers hold. A type of
/// its own for each, so that no function compiled for one is mistaken for another's.
struct Sse2 {
  static constexpr std::string_view name = "SSE2";
  static constexpr int width = 2;
};
struct Avx2 {
  static constexpr std::string_view name = "AVX2";
  static constexpr int width = 4;
};
struct Avx512 {
  static constexpr std::string_view name = "AVX-512";
  static constexpr int width = 8;
};

}  // namespace gyrostat::targets
