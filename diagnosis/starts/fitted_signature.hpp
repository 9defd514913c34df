#pragma once

#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {

/// An effect whose size is linear: its best amplitude, given everything else.
template <class E, class Set>
E scaled(const Evidence& e, Trace trace, E effect, const Set& set) {
  set(effect, 1.0);
  set(effect, match(signatures(e, trace, {effect}), trace_of(e, trace)).amplitudes[0]);
  return effect;
}

/// Amplitude and one nonlinear parameter together.
template <class E, class Set>
E scaled_over(const Evidence& e, Trace trace, E effect, double E::*shape, double low, double high,
              const Set& set) {
  const auto seen = trace_of(e, trace);
  set(effect, 1.0);
  effect.*shape = best_of(low, high, [&](double value) {
    E trial = effect;
    trial.*shape = value;
    return match(signatures(e, trace, {trial}), seen).unexplained;
  });
  set(effect, match(signatures(e, trace, {effect}), seen).amplitudes[0]);
  return effect;
}

/// An effect of fixed size with one parameter.
template <class E>
E shaped(const Evidence& e, Trace trace, E effect, double E::*shape, double low, double high) {
  const auto seen = trace_of(e, trace);
  effect.*shape = best_of(low, high, [&](double value) {
    E trial = effect;
    trial.*shape = value;
    return (seen - signatures(e, trace, {trial})).squaredNorm();
  });
  return effect;
}

}  // namespace gyrostat::gap
