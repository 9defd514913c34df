#pragma once

#include <array>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/pack.hpp>
#include <gyrostat/core/plugin.hpp>

namespace gyrostat {

/// A filter's loop for one instruction set; included by the files that are compiled for it. All
/// that it calls is inlined or has `Target` in its name: a function with neither might be linked
/// into code that other machines run (tests/targets.cmake looks for such names).
template <class Target>
struct FilterKernel {
  template <class F, int N>
  [[gnu::always_inline]] static void store_learned(const F& filter, const Lane* lanes,
                                                   LearnedParameters* Lane::*to) {
    if constexpr (requires { filter.learned(); }) {
      const auto learned = filter.learned();
      for (int l = 0; l < N; ++l) {
        auto& out = *(lanes[l].*to);
        out.phi = learned.phi[l];
        out.phi_std = learned.phi_std[l];
        out.delta1_dps = learned.delta1_dps[l];
        out.delta2_dps = learned.delta2_dps[l];
      }
    }
  }

  template <template <class> class Filter, int N>
  [[gnu::flatten]] static void run(const double* parameters, const Lane* lanes,
                                   std::size_t samples) {
    using P = Pack<Target, N>;
    using F = Filter<P>;
    const auto gather = [&](const double* Lane::*channel, std::size_t k) {
      alignas(64) double values[N];
      unrolled<N>([&]<int l>() { values[l] = (lanes[l].*channel)[k]; });
      return P::load(values);
    };
    const auto scatter = [&](const P& pack, double* Lane::*channel, std::size_t k) {
      alignas(64) double values[N];
      pack.store(values);
      unrolled<N>([&]<int l>() { (lanes[l].*channel)[k] = values[l]; });
    };

    typename F::Parameters p;
    int f = 0;
    for (const auto& field : F::Parameters::fields())
      p.*(field.member) = P::load(parameters + N * f++);
    F filter(p);
    store_learned<F, N>(filter, lanes, &Lane::learned_first);
    for (std::size_t k = 0; k < samples; ++k) {
      Sample<P> sample;
      sample.gyro_dps = gather(&Lane::gyro_dps, k);
      if constexpr (F::needs.truth) {
        sample.true_rate_dps = gather(&Lane::true_rate_dps, k);
        sample.true_drift_dps = gather(&Lane::true_drift_dps, k);
      }
      const auto step = filter.step(sample);
      scatter(step.estimate_dps, &Lane::estimate_dps, k);
      scatter(step.estimate_variance, &Lane::estimate_variance, k);
      scatter(step.innovation_dps, &Lane::innovation_dps, k);
      scatter(step.innovation_variance, &Lane::innovation_variance, k);
      alignas(64) double codes[N];
      step.status.code.store(codes);
      unrolled<N>(
          [&]<int l>() { lanes[l].status[k] = static_cast<Status>(static_cast<int>(codes[l])); });
    }
    store_learned<F, N>(filter, lanes, &Lane::learned_last);
  }
};

/// The kernels of some filters for one instruction set, in packs of all the sizes that it is for.
template <class Target, class... Plugins>
constexpr auto pack_filters(PluginList<Plugins...> /*filters*/) {
  constexpr auto of = []<class Plugin, int... N>(Plugin, std::integer_sequence<int, N...>) {
    return std::array{PackedFilter{Plugin::id, N,
                                   &FilterKernel<Target>::template run<Plugin::template on, N>}...};
  };
  using Lanes = typename Target::Lanes;
  std::array<PackedFilter, sizeof...(Plugins) * Lanes::size()> all;
  std::size_t at = 0;
  const auto append = [&](const auto& some) {
    for (const auto& one : some) all[at++] = one;
  };
  (append(of(Plugins{}, Lanes{})), ...);
  return all;
}

}  // namespace gyrostat
