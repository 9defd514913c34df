#include <gyrostat/diagnosis/likelihood/truncation.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/counts_near_zero.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t stretch = 256;  // samples, over which the level is one

template <class Do>
void each_stretch(std::span<const Span> spans, const Do& act) {
  for (const auto& span : spans)
    for (std::size_t first = span.first; first < span.last; first += stretch)
      act(first, std::min(first + stretch, span.last));
}

}  // namespace

bool is_cut_off(const Conditions& conditions, const std::vector<double>& z, double lsb_dps) {
  if (!(lsb_dps > 0.0)) return false;
  constexpr double fewest = 20.0;  // within reach, of a stretch that says anything
  std::vector<CountsNearZero> stretches;
  each_stretch(conditions.spans(Part::train), [&](std::size_t first, std::size_t last) {
    CountsNearZero counts{};
    for (std::size_t i = first; i < last; ++i)
      if (const double k = std::nearbyint(z[i] / lsb_dps); std::abs(k) <= reach_of_zero)
        counts[static_cast<std::size_t>(static_cast<int>(k) + reach_of_zero)] += 1.0;
    if (std::accumulate(counts.begin(), counts.end(), 0.0) >= fewest) stretches.push_back(counts);
  });
  return are_cut_off(std::move(stretches));
}

std::vector<double> middles_of_cut_off(const Conditions& conditions, const std::vector<double>& z,
                                       double lsb_dps) {
  const auto& reference = conditions.series().rate_ref_dps;
  const auto known = [&](std::size_t i) { return reference.empty() ? 0.0 : reference[i]; };
  auto middles = z;
  for (double& value : middles)
    if (value != 0.0) value += std::copysign(0.5 * lsb_dps, value);
  const NormalStream either(0, 0, "side of a zero");
  for (const Part part : both_parts)
    each_stretch(conditions.spans(part), [&](std::size_t first, std::size_t last) {
      double sum = 0.0, squares = 0.0, count = 0.0;
      for (std::size_t i = first; i < last; ++i) {
        const double error = middles[i] - known(i);
        if (is_missing(error)) continue;
        sum += error;
        squares += error * error;
        count += 1.0;
      }
      if (count == 0.0) return;
      const double bias = sum / count;
      const double deviation =
          std::max(std::sqrt(std::max(squares / count - bias * bias, 0.0)), 0.1 * lsb_dps);
      for (std::size_t i = first; i < last; ++i) {
        if (z[i] != 0.0 || is_missing(known(i))) continue;
        const double level = known(i) + bias;
        const double negative = below(0.0, level, deviation) - below(-lsb_dps, level, deviation);
        const double positive = below(lsb_dps, level, deviation) - below(0.0, level, deviation);
        const bool is_negative = either.uniform(i) * (negative + positive) < negative;
        middles[i] = is_negative ? -0.5 * lsb_dps : 0.5 * lsb_dps;
      }
    });
  return middles;
}

}  // namespace gyrostat::gap
