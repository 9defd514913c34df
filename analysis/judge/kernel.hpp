#pragma once

#include <array>
#include <new>
#include <type_traits>
#include <utility>

#include <gyrostat/analysis/judge/judge.hpp>
#include <gyrostat/analysis/judge/kernels.hpp>

namespace gyrostat::judge {

/// The judge on T behind pointers; all that it calls is inlined or has T in its name, since it may
/// be compiled for an instruction set that other machines lack.
template <class T>
struct Kernel {
  static_assert(std::is_trivially_destructible_v<Judge<T>>);
  [[gnu::flatten]] static void start(void* state) { ::new (state) Judge<T>(); }
  [[gnu::flatten]] static void add(void* state, const JudgedSteps& steps) {
    static_cast<Judge<T>*>(state)->add(steps);
  }
  [[gnu::flatten]] static void finish(const void* state, TrackErrors* errors) {
    for (int l = 0; l < Lanes<T>::count; ++l)
      static_cast<const Judge<T>*>(state)->finish(l, errors[l]);
  }
  [[gnu::flatten]] static void uncompensated(const JudgedSteps& steps, double* sums) {
    constexpr int lanes = Lanes<T>::count;
    T count = Lanes<T>::load(sums), squares = Lanes<T>::load(sums + lanes);
    for (std::size_t k = 0; k < steps.samples; ++k) {
      const T error = Lanes<T>::load(steps.true_drift_dps + k * lanes) +
                      Lanes<T>::load(steps.random_error_dps + k * lanes);
      const auto missing = is_missing(error);
      count += select(missing, T(0.0), T(1.0));
      squares += select(missing, T(0.0), error * error);
    }
    Lanes<T>::store(count, sums);
    Lanes<T>::store(squares, sums + lanes);
  }

  static constexpr JudgeKernel all{Lanes<T>::count, sizeof(Judge<T>), &start, &add,
                                   &finish,         &uncompensated};
};

template <class Target, template <class, int> class Pack, int... N>
constexpr auto kernels_of(std::integer_sequence<int, N...> /*lanes*/) {
  return std::array{Kernel<Pack<Target, N>>::all...};
}

}  // namespace gyrostat::judge
