#pragma once

#include <array>

#include "core/filters/list.hpp"
#include "core/packed/kernels.hpp"
#include "core/packed/normals.hpp"
#include "core/packed/pack.hpp"

namespace gyrostat {

/// The kernels of one instruction set; included by the one file that is compiled for it. All that
/// it calls is inlined or has `Target` in its name: a function with neither might be linked into
/// code that other machines run (tests/targets.cmake looks for such names).
template <class Target>
struct KernelTable {
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

  template <class Plugin, int... N>
  static constexpr auto of_filter() {
    if constexpr (requires { Plugin::type::packs_trials; })
      return std::array{PackedFilter{Plugin::id, N, &run<Plugin::template on, N>}...};
    else
      return std::array<PackedFilter, 0>{};
  }

  template <int... N, class... Plugins>
  static constexpr auto of_filters(PluginList<Plugins...> /*all*/) {
    std::array<PackedFilter, (of_filter<Plugins, N...>().size() + ...)> all;
    std::size_t at = 0;
    const auto append = [&](const auto& some) {
      for (const auto& one : some) all[at++] = one;
    };
    (append(of_filter<Plugins, N...>()), ...);
    return all;
  }

  [[gnu::flatten]] static void normals(const NormalAddress& at, std::uint32_t first, double* out) {
    NormalBlocks<Target, normal_blocks>::normals(at, first, out);
  }
};

}  // namespace gyrostat
