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

/// `count`, one more where the mask holds: an addition of the lanes that it concerns, where an
/// instruction set has that.
template <class M, class T>
T one_more(const M& mask, const T& count) {
  return select(mask, T(count + T(1.0)), count);
}

/// How many numbers stand side by side in a T, and how they come from memory and go there.
template <class T>
struct Lanes {
  static constexpr int count = 1;
  static T load(const double* from) { return *from; }
  static void store(const T& value, double* to) { *to = value; }
  static double at(const T& value, int /*lane*/) { return value; }
};
template <class T>
requires requires { T::lanes; }
struct Lanes<T> {
  static constexpr int count = T::lanes;
  static T load(const double* from) { return T::load(from); }
  static void store(const T& value, double* to) { value.store(to); }
  static double at(const T& value, int lane) { return value[lane]; }
};

}  // namespace gyrostat
