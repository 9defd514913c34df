#pragma once

#include <array>
#include <cmath>
#include <utility>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/pack.hpp>
#include <gyrostat/generators/packed/kernels.hpp>

namespace gyrostat {

/// A SignalKernel for one instruction set; all that it calls is inlined or has `Target` in its
/// name.
template <class Target, int N>
struct SignalOf {
  using P = Pack<Target, N>;
  using Normals = NormalBlocks<Target, normal_blocks>;

  [[gnu::always_inline]] static void draw(const NormalAddress& at, const std::uint32_t* trials,
                                          std::size_t first, std::size_t samples, double* out) {
    constexpr std::size_t blocks = normal_blocks / N, each = 4 * blocks;
    for (std::size_t k = 0; k < samples; k += each)
      Normals::template side_by_side<N>(at, trials, static_cast<std::uint32_t>((first + k) / 4),
                                        out + k * N);
  }

  [[gnu::flatten]] static void gyro(const GyroNoise& noise, std::size_t first, std::size_t samples,
                                    const double* steady_dps, double* gyro_dps,
                                    double* random_error_dps) {
    alignas(64) double deviates[signal_stretch * N];
    const double phi = noise.model.phi, delta1 = noise.model.delta1_dps,
                 delta2 = noise.model.delta2_dps, std = noise.model.measurement_noise_std_dps;
    if (delta1 == 0.0 && delta2 == 0.0) {
      for (std::size_t k = 0; k < samples; ++k) P(0.0).store(random_error_dps + k * N);
    } else {
      draw(noise.random_error, noise.trials, first, samples, deviates);
      P level = P::load(noise.state), difference = P::load(noise.state + N),
        previous = P::load(noise.state + 2 * N);
      for (std::size_t k = 0; k < samples; ++k) {
        const P a = P::load(deviates + k * N);
        if (first + k == 0)
          difference = P(delta1) * a + P::load(noise.first_difference_dps);
        else
          difference = P(phi) * difference + P(delta1) * a - P(delta2) * previous;
        previous = a;
        level += difference;
        level.store(random_error_dps + k * N);
      }
      level.store(noise.state);
      difference.store(noise.state + N);
      previous.store(noise.state + 2 * N);
    }
    for (std::size_t k = 0; k < samples; ++k)
      (P(steady_dps[k]) + P::load(random_error_dps + k * N)).store(gyro_dps + k * N);
    if (std == 0.0) return;
    draw(noise.white_noise, noise.trials, first, samples, deviates);
    for (std::size_t k = 0; k < samples; ++k)
      (P::load(gyro_dps + k * N) + P(std) * P::load(deviates + k * N)).store(gyro_dps + k * N);
  }

  [[gnu::flatten]] static void heading(const CompassNoise& noise, std::size_t first,
                                       std::size_t samples, const double* t_s,
                                       const double* turned_deg, double* heading_deg) {
    alignas(64) double deviates[signal_stretch * N];
    for (std::size_t k = 0; k < samples; ++k) P(turned_deg[k]).store(heading_deg + k * N);
    if (noise.noise_std_deg != 0.0) {
      draw(noise.white_noise, noise.trials, first, samples, deviates);
      for (std::size_t k = 0; k < samples; ++k)
        (P::load(heading_deg + k * N) + P(noise.noise_std_deg) * P::load(deviates + k * N))
            .store(heading_deg + k * N);
    }
    for (std::size_t n = 0; n < noise.disturbances.size(); ++n) {
      const auto& [of, at] = noise.disturbances.data()[n];
      bool drawn = false;
      for (std::size_t k = 0; k < samples; ++k) {
        const double into = t_s[k] - of.start_s;
        if (into < 0.0 || into >= of.duration_s) continue;
        if (!drawn) draw(at, noise.trials, first, samples, deviates);
        drawn = true;
        const P disturbed = P(of.offset_deg) + P(of.noise_std_deg) * P::load(deviates + k * N);
        (P::load(heading_deg + k * N) + disturbed).store(heading_deg + k * N);
      }
    }
    for (std::size_t i = 0; i < samples * N; ++i)
      heading_deg[i] = heading_deg[i] - 360.0 * __builtin_floor((heading_deg[i] + 180.0) / 360.0);
  }

  [[gnu::flatten]] static void spread(const double* values, std::size_t samples, double* out) {
    for (std::size_t k = 0; k < samples; ++k) P(values[k]).store(out + k * N);
  }

  static constexpr SignalKernel all{N, &gyro, &heading, &spread};
};

template <class Target, int... N>
constexpr auto signals_of(std::integer_sequence<int, N...> /*lanes*/) {
  return std::array{SignalOf<Target, N>::all...};
}

}  // namespace gyrostat
