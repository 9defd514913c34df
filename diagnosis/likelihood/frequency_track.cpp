#include <gyrostat/diagnosis/likelihood/frequency_track.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/likelihood/log_bessel.hpp>

namespace gyrostat::gap {
namespace {

/// A sine half way between two bins shows (2 / pi)^2 of its power in each.
constexpr double half_way = 4.0 / (std::numbers::pi * std::numbers::pi);

double bell(double x, double std) { return std::exp(-0.5 * (x / std) * (x / std)); }

/// Of a sine with such a power over the noise's: Rice's density over the exponential one.
Scaled ratio(double seen, double power) {
  const auto bessel = bessel_i0(2.0 * std::sqrt(seen * power));
  return {bessel.factor, bessel.exponent - power};
}

}  // namespace

double Wandering::step_hz() const {
  return is_anywhere() ? std_hz : std_hz * std::sqrt(-std::expm1(-2.0 / memory_blocks));
}

FrequencyTrack::FrequencyTrack(const BlockPowers& blocks, const Wandering& wandering)
    : blocks_(blocks) {
  const std::size_t count = 2 * blocks.bins() - 1;
  const double state_hz = 0.5 * blocks.resolution_hz;
  // What a state stands for has a width.
  const auto widened = [&](double std_hz) { return std::hypot(std_hz, 0.6 * state_hz); };
  const double step_hz = widened(wandering.step_hz());
  double stay = 1.0;
  first_.assign(count, 1.0 / static_cast<double>(count));
  if (!wandering.is_anywhere()) {
    stay = std::exp(-1.0 / wandering.memory_blocks);
    double sum = 0.0;
    for (std::size_t s = 0; s < count; ++s)
      sum += first_[s] = bell(frequency_hz(s) - wandering.centre_hz, widened(wandering.std_hz));
    for (double& p : first_) p /= sum;
  }
  constexpr double reach = 4.0;
  const auto state = [&](double hz) {
    return static_cast<std::size_t>(std::clamp(std::round((hz - frequency_hz(0)) / state_hz), 0.0,
                                               static_cast<double>(count - 1)));
  };
  for (std::size_t s = 0; s < count; ++s) {
    const double mean_hz = wandering.centre_hz + stay * (frequency_hz(s) - wandering.centre_hz);
    Row row{.from = state(mean_hz - reach * step_hz), .probabilities = {}};
    double sum = 0.0;
    for (std::size_t k = row.from, last = state(mean_hz + reach * step_hz); k <= last; ++k)
      sum += row.probabilities.emplace_back(bell(frequency_hz(k) - mean_hz, step_hz));
    for (double& p : row.probabilities) p /= sum;
    next_.push_back(std::move(row));
  }
}

std::vector<double> FrequencyTrack::moved(const std::vector<double>& states) const {
  std::vector<double> then(states.size(), 0.0);
  for (std::size_t s = 0; s < states.size(); ++s)
    for (std::size_t k = 0; k < next_[s].probabilities.size(); ++k)
      then[next_[s].from + k] += states[s] * next_[s].probabilities[k];
  return then;
}

template <class Visit>
double FrequencyTrack::forward(const std::vector<std::vector<double>>& span,
                               const std::vector<double>& power, const Visit& visit) const {
  double sum = 0.0;
  std::vector<double> states, before;
  std::vector<Scaled> ratios(first_.size());
  for (const auto& powers : span) {
    states = states.empty() ? first_ : moved(states);
    before = states;
    if (!powers.empty()) {
      double most = -1e300;
      Scaled half_below{};
      for (std::size_t s = 0; s < states.size(); s += 2) {
        const std::size_t k = s / 2;
        ratios[s] = ratio(powers[k], power[k]);
        const auto half = ratio(powers[k], half_way * power[k]);
        if (s > 0) {
          ratios[s - 1] = {half_below.factor * half.factor, half_below.exponent + half.exponent};
          most = std::max(most, ratios[s - 1].exponent);
        }
        most = std::max(most, ratios[s].exponent);
        half_below = half;
      }
      double total = 0.0;
      for (std::size_t s = 0; s < states.size(); ++s)
        total += states[s] *= ratios[s].factor * std::exp(ratios[s].exponent - most);
      for (double& p : states) p /= total;
      sum += most + std::log(total);
    }
    visit(before, states);
  }
  return sum;
}

double FrequencyTrack::log_gain(const std::vector<double>& power) const {
  double sum = 0.0;
  for (const auto& span : blocks_.spans)
    sum += forward(span, power, [](const auto&, const auto&) {});
  return sum;
}

std::vector<double> FrequencyTrack::spectrum(const std::vector<double>& power) const {
  std::vector<double> all(power.size(), 1.0);
  for (std::size_t s = 0; s < first_.size(); ++s)
    for (std::size_t k = s / 2; k <= (s + 1) / 2; ++k)
      all[k] += (s % 2 == 0 ? 1.0 : half_way) * first_[s] * power[k];
  return all;
}

Wandering FrequencyTrack::seen(const std::vector<double>& power) const {
  double count = 0.0, sum = 0.0, squares = 0.0, pairs = 0.0, of_pairs = 0.0;
  std::vector<std::vector<double>> tracks;
  for (const auto& span : blocks_.spans) {
    std::vector<std::vector<double>> before, after;
    forward(span, power, [&](const auto& b, const auto& a) {
      before.push_back(b);
      after.push_back(a);
    });
    // Backward: a state has the share of what follows that comes from it.
    auto& track = tracks.emplace_back(span.size());
    std::vector<double> whole;
    for (std::size_t t = span.size(); t-- > 0;) {
      std::vector<double> now = after[t];
      if (!whole.empty())
        for (std::size_t s = 0; s < now.size(); ++s) {
          double follows = 0.0;
          for (std::size_t k = 0; k < next_[s].probabilities.size(); ++k) {
            const std::size_t to = next_[s].from + k;
            if (before[t + 1][to] > 0.0)
              follows += next_[s].probabilities[k] * whole[to] / before[t + 1][to];
          }
          now[s] *= follows;
        }
      whole = now;
      for (std::size_t s = 0; s < now.size(); ++s) {
        track[t] += now[s] * frequency_hz(s);
        squares += now[s] * frequency_hz(s) * frequency_hz(s);
      }
      sum += track[t];
      count += 1.0;
    }
  }
  Wandering found{.centre_hz = sum / std::max(count, 1.0)};
  found.std_hz =
      std::sqrt(std::max(squares / std::max(count, 1.0) - found.centre_hz * found.centre_hz, 0.0));
  double own = 0.0;
  for (const auto& track : tracks)
    for (std::size_t t = 0; t + 1 < track.size(); ++t) {
      const double a = track[t] - found.centre_hz, b = track[t + 1] - found.centre_hz;
      of_pairs += a * b;
      own += 0.5 * (a * a + b * b);
      pairs += 1.0;
    }
  constexpr double shortest = 1.0, longest = 1e3;
  const double alike = own > 0.0 ? of_pairs / own : 0.0;
  found.memory_blocks =
      alike > 0.0 && alike < 1.0 ? std::clamp(-1.0 / std::log(alike), shortest, longest) : shortest;
  return found;
}

}  // namespace gyrostat::gap
