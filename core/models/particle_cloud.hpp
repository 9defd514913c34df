#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <gyrostat/core/models/model_nl.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/numerics/resampling.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat {

template <class T>
struct ParticleParameters : RandomErrorParameters<T>, InitialParameterStates<T> {
  T particles{500.0};
  T resample_below{0.5};
  T walk{0.05};
  T seed{1.0};

  static constexpr auto fields() {
    using P = ParticleParameters;
    return join_fields<P, T>(
        RandomErrorParameters<T>::fields(), InitialParameterStates<T>::fields(),
        std::array{
            Field{"particles", &P::particles, "1", Range{.from = 2, .to = 2e4, .whole = true},
                  "number of particles, N"},
            Field{"resample_below", &P::resample_below, "1", ranges::fraction,
                  "resample when the effective number of particles falls below this part of N"},
            Field{"walk", &P::walk, "1", ranges::fraction,
                  "walk of phi, delta1 and delta2 a sample, as a part of their initial deviation"},
            Field{"seed", &P::seed, "1", Range{.from = 0, .to = 4294967295.0, .whole = true},
                  "seed of the filter's own draws"},
        });
  }
};

/// Weighted particles [x_k, x_{k-1}, phi, delta1, delta2] of model NL.
///
/// phi (held within (-1, 1)), delta1 and delta2 are drawn from their prior and then walk by `walk`
/// of its deviations a sample, the artificial evolution of Gordon, Salmond and Smith (1993), made
/// up for at resampling; without it the cloud runs out of values. A parameter without initial doubt
/// does not walk. Draws are addressed by (seed, step, particle): the same bits on any thread.
template <class T>
class ParticleCloud {
 public:
  explicit ParticleCloud(const ParticleParameters<T>& p)
      : p_(p),
        walk_std_(p.walk * Vector<T, 3>(p.initial_phi_std, p.initial_delta1_std_dps,
                                        p.initial_delta2_std_dps)),
        states_(whole(p.particles)),
        weights_(states_.size(), T(1.0) / p.particles) {
    State mean, std;
    mean << p.initial_x_dps, p.initial_x_previous_dps, p.phi, p.delta1_dps, p.delta2_dps;
    std << p.initial_x_std_dps, p.initial_x_previous_std_dps, p.initial_phi_std,
        p.initial_delta1_std_dps, p.initial_delta2_std_dps;
    const auto draws = normals("particle_prior", 5 * states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) {
      for (int j = 0; j < 5; ++j)
        states_[i](j) = mean(j) + std(j) * draws[5 * i + static_cast<std::size_t>(j)];
      hold_stationary(states_[i]);
    }
  }

  /// One step of the model. a_k and a_{k-1} are both fresh, so that of delta1 a_k - delta2 a_{k-1}
  /// only the size shows.
  void advance() {
    using std::sqrt;
    ++step_;
    const auto draws = normals("particle", states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) {
      State& s = states_[i];
      const T size = sqrt(s(3) * s(3) + s(4) * s(4));
      const T x = s(0) + s(2) * (s(0) - s(1)) + size * draws[i];
      s(1) = s(0);
      s(0) = x;
    }
  }

  /// Weights by the likelihood of z = x + v, v ~ N(0, R). False, with equal weights, where it is
  /// zero for every particle.
  [[nodiscard]] bool weigh(const T& z, const T& R) {
    using std::exp;
    T total(0.0);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const T error = z - states_[i](0);
      weights_[i] *= exp(T(-0.5) * error * error / R);
      total += weights_[i];
    }
    if (!(total > T(0.0))) {
      weights_.assign(weights_.size(), T(1.0) / p_.particles);
      return false;
    }
    for (T& w : weights_) w /= total;
    return true;
  }

  /// Resamples where few particles carry the weight.
  void refresh() {
    T squares(0.0);
    for (const T& w : weights_) squares += w * w;
    if (T(1.0) / squares >= p_.resample_below * p_.particles) return;
    const NormalStream uniforms(whole(p_.seed), 0, "particle_resampling");
    const auto chosen = systematic_resampling(weights_, T(uniforms.uniform(step_)));
    std::vector<State> next(states_.size());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = states_[chosen[i]];
    states_ = std::move(next);
    weights_.assign(weights_.size(), T(1.0) / p_.particles);
    if (walk_std_.maxCoeff() > T(0.0)) walk_parameters();
  }

  /// Moves x_k and x_{k-1}, and spreads x_k.
  void move(const T& distance, const T& std) {
    const auto draws = normals("particle_move", states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) {
      states_[i](0) += distance + std * draws[i];
      states_[i](1) += distance;
    }
  }

  /// Weighted mean and variance of state `i`.
  std::pair<T, T> moments(int i) const {
    const T base = states_.front()(i);
    T offset(0.0), square(0.0);
    for (std::size_t k = 0; k < states_.size(); ++k) offset += weights_[k] * (states_[k](i) - base);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const T d = states_[k](i) - base - offset;
      square += weights_[k] * d * d;
    }
    return {base + offset, square};
  }

 private:
  using State = Vector<T, ModelNl<T>::states>;

  /// A whole parameter of any ordered scalar.
  static std::uint64_t whole(const T& value) {
    std::uint64_t number = 0;
    for (std::uint64_t bit = 1ULL << 31U; bit > 0; bit >>= 1U)
      if (T(static_cast<double>(number + bit)) <= value) number += bit;
    return number;
  }

  static void hold_stationary(State& s) {
    const T edge(1.0 - 1e-6);
    s(2) = std::clamp(s(2), T(-edge), edge);
  }

  std::vector<T> normals(std::string_view stream, std::size_t count) const {
    std::vector<double> draws(count);
    NormalStream(whole(p_.seed), step_, stream).fill(0, draws);
    return {draws.begin(), draws.end()};
  }

  void walk_parameters() {
    using std::sqrt;
    const auto draws = normals("particle_walk", 3 * states_.size());
    const T time = sqrt(T(static_cast<double>(step_ - walked_)));
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Vector<T, 3> draw(draws[3 * i], draws[3 * i + 1], draws[3 * i + 2]);
      states_[i].template tail<3>() += time * walk_std_.cwiseProduct(draw);
      hold_stationary(states_[i]);
    }
    walked_ = step_;
  }

  ParticleParameters<T> p_;
  Vector<T, 3> walk_std_;
  std::vector<State> states_;
  std::vector<T> weights_;
  std::uint32_t step_ = 0;
  std::uint32_t walked_ = 0;
};

}  // namespace gyrostat
