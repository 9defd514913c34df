#pragma once

#include <cstddef>

#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/core/packed/pack.hpp>

namespace gyrostat {

/// A filter of N trials in registers of `Target` on measurements from a register, its results
/// summed into one: what is left is what a step waits for of the one before.
template <class Target, template <class> class Filter, int N>
[[gnu::flatten]] double recursion(std::size_t steps, double size) {
  using P = Pack<Target, N>;
  using F = Filter<P>;
  typename F::Parameters p;
  const typename Filter<double>::Parameters plain;
  unrolled<static_cast<int>(F::Parameters::fields().size())>([&]<int f>() {
    p.*(F::Parameters::fields()[f].member) =
        P(plain.*(Filter<double>::Parameters::fields()[f].member));
  });
  F filter(p);
  P z(size), sum(0.0);
  for (std::size_t k = 0; k < steps; ++k) {
    Sample<P> sample;
    sample.gyro_dps = z;
    const auto step = filter.step(sample);
    sum += step.estimate_dps + step.estimate_variance + step.innovation_dps +
           step.innovation_variance + step.status.code;
    z = -z;
  }
  return sum[0];
}

}  // namespace gyrostat
