#pragma once

#include <array>
#include <new>
#include <type_traits>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/pack.hpp>
#include <gyrostat/core/plugin.hpp>

namespace gyrostat {

/// A filter's loop over packs for one instruction set; included by the files that are compiled for
/// it. All that it calls is inlined or has `Target` in its name: a function with neither might be
/// linked into code that other machines run (tests/targets.cmake looks for such names).
template <class Target, template <class> class Filter, int N>
struct FilterKernel {
  using P = Pack<Target, N>;
  using F = Filter<P>;
  static_assert(std::is_trivially_destructible_v<F>);

  [[gnu::flatten]] static void start(void* state, const double* parameters) {
    typename F::Parameters p;
    int f = 0;
    for (const auto& field : F::Parameters::fields())
      p.*(field.member) = P::load(parameters + N * f++);
    ::new (state) F(p);
  }

  [[gnu::flatten]] static void run(void* state, const PackedSamples& in, const PackedSteps& out,
                                   std::size_t samples) {
    F filter = *static_cast<const F*>(state);
    std::size_t k = 0;
    if constexpr (requires { filter.cycle(); }) {
      if (auto cycle = filter.cycle(); cycle.comes_round()) {
        Step<P> step;
        for (; k < samples && filter.step(sample_at(in, k), cycle, step); ++k) store(step, out, k);
        filter.end(cycle);
      }
    }
    for (; k < samples; ++k) store(filter.step(sample_at(in, k)), out, k);
    *static_cast<F*>(state) = filter;
  }

  [[gnu::flatten]] static void learned(const void* state, LearnedParameters* of_lanes) {
    if constexpr (requires(const F& filter) { filter.learned(); }) {
      const auto learned = static_cast<const F*>(state)->learned();
      for (int l = 0; l < N; ++l) {
        of_lanes[l].phi = learned.phi[l];
        of_lanes[l].phi_std = learned.phi_std[l];
        of_lanes[l].delta1_dps = learned.delta1_dps[l];
        of_lanes[l].delta2_dps = learned.delta2_dps[l];
      }
    }
  }

 private:
  static Sample<P> sample_at(const PackedSamples& in, std::size_t k) {
    Sample<P> sample;
    sample.gyro_dps = P::load(in.gyro_dps + N * k);
    if constexpr (F::needs.truth) {
      sample.true_rate_dps = P::load(in.true_rate_dps + N * k);
      sample.true_drift_dps = P::load(in.true_drift_dps + N * k);
    }
    return sample;
  }

  static void store(const Step<P>& step, const PackedSteps& out, std::size_t k) {
    step.estimate_dps.store(out.estimate_dps + N * k);
    step.estimate_variance.store(out.estimate_variance + N * k);
    step.innovation_dps.store(out.innovation_dps + N * k);
    step.innovation_variance.store(out.innovation_variance + N * k);
    step.status.code.store(out.status + N * k);
  }

 public:
  static constexpr PackedFilter named(std::string_view id) {
    constexpr bool learns = requires(const F& filter) { filter.learned(); };
    return {id, N, sizeof(F), &start, &run, learns ? &learned : nullptr};
  }
};

/// The kernels of some filters for one instruction set, in packs of all the sizes that it is for.
template <class Target, class... Plugins>
constexpr auto pack_filters(PluginList<Plugins...> /*filters*/) {
  constexpr auto of = []<class Plugin, int... N>(Plugin, std::integer_sequence<int, N...>) {
    return std::array{FilterKernel<Target, Plugin::template on, N>::named(Plugin::id)...};
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
