#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/slow_noise.hpp>
#include <gyrostat/generators/effects/gauss_markov.hpp>

namespace gyrostat::gap {

/// A decaying error of one memory, or of two that are nearly one.
template <>
struct Diagnosed<effects::GaussMarkov> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::GaussMarkov::std_dps,
                                                 &effects::GaussMarkov::correlation_time_s};

  static std::size_t chosen_parameters(const effects::GaussMarkov& effect) {
    return std::size_t{effect.is_of_second_order()};
  }

  static std::vector<effects::GaussMarkov> guesses(const Beside& beside) {
    std::vector<effects::GaussMarkov> all;
    for (const double order : {1.0, 2.0})
      for (const double memory_s : beside.memories_s())
        all.push_back({0.7 * beside.slow_std_dps(), memory_s, order});
    return all;
  }

  static void enter(const effects::GaussMarkov& effect, NoiseLaw& law) {
    const double variance = effect.std_dps * effect.std_dps, memory_s = effect.time_constant_s();
    if (!effect.is_of_second_order()) return law.decaying.push_back({variance, memory_s});
    // A difference of two that decay at nearly one pace.
    constexpr double apart = 1.2, square = apart * apart;
    law.decaying.push_back({variance * square / (square - 1.0), memory_s * apart});
    law.decaying.push_back({-variance / (square - 1.0), memory_s / apart});
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::GaussMarkov& effect, const Conditions& c) {
    // One that is smooth all along a recording is any curve.
    constexpr double least_memories = 3.0;
    const double duration_s = c.interval_s() * static_cast<double>(c.size());
    if (effect.is_of_second_order() && effect.correlation_time_s * least_memories > duration_s)
      return false;
    // What forgets as fast as a filter of the noise does must be seen by means of clusters.
    constexpr double fewest_means = 2.0;
    return is_slow(effect.correlation_time_s, c) ||
           effect.correlation_time_s > fewest_means * c.slow_interval_s();
  }
};

}  // namespace gyrostat::gap
