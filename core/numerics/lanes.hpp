#pragma once

#include <utility>

namespace gyrostat {

/// `body<i>()` for i = 0 ... N - 1: a loop that is unrolled before the compiler decides what stays
/// in registers.
template <int N, class Body>
[[gnu::always_inline]] inline void unrolled(const Body& body) {
  [&]<int... i>(std::integer_sequence<int, i...>) { (body.template operator()<i>(), ...); }
  (std::make_integer_sequence<int, N>{});
}

/// What a comparison of two T gives. A number stands alone and answers with a bool; a pack (see
/// core/packed/pack.hpp) is several numbers side by side and answers with a mask.
template <class T>
struct MaskOf {
  using type = bool;
};
template <class T>
using Mask = typename MaskOf<T>::type;

inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }

/// `yes` where the mask holds, else `no`: the branch of a kernel that also runs on packs.
template <class T>
T select(bool mask, const T& yes, const T& no) {
  return mask ? yes : no;
}

}  // namespace gyrostat
