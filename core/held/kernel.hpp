#pragma once

#include <array>
#include <utility>

#include <gyrostat/core/held/kernels.hpp>
#include <gyrostat/core/packed/pack.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// A HoldKernel for one instruction set; all that it calls is inlined or has `Target` in its name.
template <class Target, int N>
struct HoldOf {
  using P = Pack<Target, N>;

  /// The operations of CompassAiding::observe, lane by lane.
  [[gnu::flatten]] static std::size_t run(double* held, const double* t_s, const double* gyro_dps,
                                          const PackedSteps& out, std::size_t samples) {
    const P from = P::load(held), least = P::load(held + N), compensated = P::load(held + 4 * N),
            estimate = P::load(held + 5 * N), variance = P::load(held + 6 * N), missing(no_value),
            status(static_cast<double>(Status::no_measurement));
    P last = P::load(held + 2 * N), turned = P::load(held + 3 * N);
    std::size_t k = 0;
    for (; k < samples; ++k) {
      const P now = P::load(t_s + k * N);
      if (!all(now - from < least)) break;
      turned += (P::load(gyro_dps + k * N) - compensated) * (now - last);
      last = now;
      estimate.store(out.estimate_dps + k * N);
      variance.store(out.estimate_variance + k * N);
      missing.store(out.innovation_dps + k * N);
      missing.store(out.innovation_variance + k * N);
      status.store(out.status + k * N);
    }
    last.store(held + 2 * N);
    turned.store(held + 3 * N);
    return k;
  }

  static constexpr HoldKernel kernel{N, &run};
};

template <class Target, int... N>
constexpr auto holds_of(std::integer_sequence<int, N...> /*lanes*/) {
  return std::array{HoldOf<Target, N>::kernel...};
}

}  // namespace gyrostat
