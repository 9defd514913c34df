#include <gyrostat/diagnosis/likelihood/slow_law.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include <gyrostat/diagnosis/likelihood/histories/kernels.hpp>
#include <gyrostat/diagnosis/likelihood/slow_recursion.hpp>

namespace gyrostat::gap {
namespace {

/// A decaying error with a memory of less than so many clusters is fast.
constexpr double shortest_memory = 0.5;

/// Variance of the mean of a decaying error over u memories, and the covariance of two neighbouring
/// means, both over the variance (Papoulis, "Probability, Random Variables and Stochastic
/// Processes", 3rd ed., 10-1).
struct MeanOf {
  double variance, neighbours;
};
MeanOf mean_over(double u) {
  if (u < 1e-4) return {1.0 - u / 3.0, 1.0 - u};
  const double lost = -std::expm1(-u);
  return {2.0 * (u - lost) / (u * u), lost * lost / (u * u)};
}

/// What noise that is fast shares with the next cluster's, as a decaying error with the covariances
/// of its mean with the next two; the second is larger where the error would else have more than
/// `most` of variance.
std::optional<SlowLaw::Part> shared_by_means(const RateGrid& grid, const NoiseLaw& fast,
                                             const std::vector<double>& gain_of_white,
                                             double cluster_s, double most) {
  auto [next, after] = grid.covariances_of_means(gain_of_white);
  const double of_unit_noise = 2.0 * fast.interval_s * fast.white;
  next *= of_unit_noise;
  after *= of_unit_noise;
  for (const auto& d : fast.decaying) {
    const double u = cluster_s / d.memory_s;
    const double shared = d.variance * mean_over(u).neighbours;
    next += shared;
    after += shared * std::exp(-u);
  }
  constexpr double least_decay = 0.05, most_decay = 0.99;
  if (!(next > 0.0)) return std::nullopt;
  const double decay =
      std::clamp(std::max(after, next * next / most) / next, least_decay, most_decay);
  return SlowLaw::Part{next / decay, decay};
}

/// Of the means of a turning Gauss-Markov process: covariances that fall and turn as its own do
/// (Papoulis, as above, with a complex rate of decay), but for the little that they are ahead.
SlowLaw::Turning turning_means(const Resonance& line, double cluster_s) {
  const std::complex<double> half = {0.5 * std::numbers::pi * line.bandwidth_hz * cluster_s,
                                     std::numbers::pi * line.centre_hz * cluster_s};
  return {line.variance * std::norm(std::sinh(half) / half), std::exp(-2.0 * half.real()),
          2.0 * half.imag()};
}

/// A line whose phase wanders, as one that has lost as much of its coherence after the same time.
Resonance as_resonance(const effects::WanderingLine& line) {
  const double lost = std::exp(-1.0);
  double shorter_s = 0.0, longer_s = 1e-3;
  while (line.coherence(longer_s) > lost && longer_s < 1e6) longer_s *= 2.0;
  for (int halved = 0; halved < 30; ++halved) {
    const double between_s = 0.5 * (shorter_s + longer_s);
    (line.coherence(between_s) > lost ? shorter_s : longer_s) = between_s;
  }
  return {0.5 * line.amplitude_dps * line.amplitude_dps, line.frequency_hz,
          1.0 / (std::numbers::pi * longer_s)};
}

/// A law of means that is put together part by part, each taking its share from what is white.
class Means {
 public:
  Means(const NoiseLaw& remembered, double variance, double interval_s)
      : law_{.white = variance,
             .walk = remembered.walk * interval_s,
             .parts = {},
             .jumps = remembered.jumps,
             .interval_s = interval_s} {
    // The mean of a walk over its cluster has a sixth of a step's variance less than its end.
    law_.white -= law_.walk / 6.0;
    take(0.25 * law_.walk);
  }

  void add(const Decaying& d) {
    // Means over u memories have covariances that fall by exp(-u) from lag to lag, from the first
    // on; that at lag 0 is a little less than where they come from. The white noise of the means
    // takes the difference up.
    const double u = law_.interval_s / d.memory_s;
    const auto mean = mean_over(u);
    law_.white += d.variance * mean.variance;
    add({d.variance * mean.neighbours * std::exp(u), std::exp(-u)}, false);
  }
  void add(const SlowLaw::Part& part, bool is_fast) {
    law_.white -= part.variance;
    law_.parts.push_back(part);
    if (!is_fast || !law_.jumps)
      take(part.variance * (1.0 - part.decay) / (1.0 + part.decay), is_fast);
  }
  void add(const SlowLaw::Turning& turning) {
    if (states_of(law_) + 2 > most_states) return;
    law_.white -= turning.variance;
    law_.turning.push_back(turning);
    take(turning.variance * (1.0 - turning.decay) / (1.0 + turning.decay), true);
  }

  /// Where its density is least, something is left of it. Beside a motion that is not yet
  /// explained, what passes for a walk is none, and need not be as smooth from mean to mean.
  SlowLaw with_something_left(bool is_beside_motion) {
    constexpr double share_left = 0.02, least_beside_motion = 0.05;
    const double least = is_beside_motion
                             ? least_beside_motion * law_.walk - (1.0 - share_left) * of_fast_
                             : share_left * size_ - least_;
    law_.white = std::max(law_.white, least);
    return std::move(law_);
  }

 private:
  /// A part adds this to the density of white noise where its own is least.
  void take(double least, bool is_fast = false) {
    least_ += least;
    size_ += std::abs(least);
    if (is_fast) of_fast_ += least;
  }

  SlowLaw law_;
  double least_ = 0.0, size_ = 0.0, of_fast_ = 0.0;
};

}  // namespace

LawBands bands_of(const NoiseLaw& law, double cluster_s) {
  LawBands bands{.fast = law, .slow = {.interval_s = law.interval_s, .duration_s = law.duration_s}};
  bands.slow.walk = std::exchange(bands.fast.walk, 0.0);
  bands.slow.jumps = std::exchange(bands.fast.jumps, std::nullopt);
  bands.fast.decaying.clear();
  NoiseLaw* band = nullptr;
  for (const auto& d : law.decaying) {
    if (band == nullptr || d.variance >= 0.0)
      band = d.memory_s < shortest_memory * cluster_s ? &bands.fast : &bands.slow;
    band->decaying.push_back(d);
  }
  return bands;
}

SlowLaw slow_law_of(const ReducedRate& reduced, const LawBands& bands,
                    const std::vector<double>& fast_density,
                    const std::vector<double>& gain_of_white) {
  const double interval_s = reduced.cluster_s();
  const double of_fast = reduced.grid().variance_of_a_mean(fast_density) * reduced.noise_of_means();
  Means means(bands.slow, of_fast, interval_s);
  for (const auto& d : bands.slow.decaying) means.add(d);
  // What shows less than that from one mean to the next is white to them.
  constexpr double least_shown = 0.02;
  const auto shows = [&](const auto& part) {
    return part.variance * part.decay > least_shown * of_fast;
  };
  // To histories of jumps, white noise must be some.
  constexpr double most_beside_jumps = 0.9;
  const double most = bands.slow.jumps ? most_beside_jumps * of_fast : 1e300;
  if (const auto shared =
          shared_by_means(reduced.grid(), bands.fast, gain_of_white, interval_s, most);
      shared && shows(*shared))
    means.add(*shared, true);
  // Nor have they room for what turns.
  if (!bands.slow.jumps) {
    const auto add_line = [&](const Resonance& line) {
      if (const auto turning = turning_means(line, interval_s); shows(turning)) means.add(turning);
    };
    for (const auto& line : bands.fast.resonances) add_line(line);
    for (const auto& line : bands.fast.wandering) add_line(as_resonance(line));
  }
  return means.with_something_left(reduced.is_beside_motion());
}

SlowLaw slow_law(const ReducedRate& reduced, const NoiseLaw& law) {
  const auto bands = bands_of(law, reduced.cluster_s());
  DensityParts parts;
  const auto density = density_of(bands.fast, reduced.grid().angles(), parts);
  return slow_law_of(reduced, bands, density, parts.gain_of_white);
}

}  // namespace gyrostat::gap
