#include <gyrostat/diagnosis/likelihood/marks.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/repeats.hpp>
#include <gyrostat/diagnosis/likelihood/resting_noise.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// Where far more samples than beside it have the largest value, or the smallest, and most of them
/// are reached by a step as there are elsewhere: readings that fail are at the end of a range too.
double clipped_at(const Conditions& conditions, const std::vector<double>& z, double end,
                  double other_end) {
  constexpr double fewest = 8.0, beside = 4.0;
  double at_end = 0.0, next = 0.0, nearest = -1e300, largest_step = 0.0, reached = 0.0;
  const double sign = end > 0.0 ? 1.0 : -1.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (z[i] != end && !is_missing(z[i])) {
        nearest = std::max(nearest, sign * z[i]);
        const auto is_between = [&](double v) { return v != end && v != other_end; };
        if (i > span.first && is_between(z[i]) && is_between(z[i - 1]) && !is_missing(z[i - 1]))
          largest_step = std::max(largest_step, std::abs(z[i] - z[i - 1]));
      }
  const auto is_near = [&](double value) { return std::abs(end - value) <= largest_step; };
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (z[i] == end) {
        at_end += 1.0;
        reached += (i > span.first && is_near(z[i - 1])) || (i + 1 < span.last && is_near(z[i + 1]))
                       ? 1.0
                       : 0.0;
      }
      next += sign * z[i] == nearest ? 1.0 : 0.0;
    }
  return at_end >= fewest && at_end > beside * next && 2.0 * reached > at_end ? std::abs(end) : 0.0;
}

/// Standard deviation of white noise of which a sample equals the one before with this probability
/// once both are rounded: a difference d is rounded to nothing with that of 1 - |d| / lsb.
double white_under_grid(double lsb_dps, double equal) {
  double low = 1e-3 * lsb_dps, high = 10.0 * lsb_dps;
  for (int k = 0; k < 60; ++k) {
    const double std_dps = std::sqrt(low * high);
    const double u = lsb_dps / (std::numbers::sqrt2 * std_dps);
    const double expected = std::erf(u / std::numbers::sqrt2) -
                            std::sqrt(2.0 / std::numbers::pi) / u * -std::expm1(-0.5 * u * u);
    (expected > equal ? low : high) = std_dps;
  }
  return low;
}

/// By how far the multiples of the step miss the values: their mean direction about one step; 0
/// where they miss none by a hundredth of it, or are not agreed.
double offset_of(const Conditions& conditions, const std::vector<double>& z, double lsb_dps) {
  constexpr double agreed = 0.9, least = 0.01;
  std::complex<double> sum;
  double count = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (is_missing(z[i])) continue;
      sum += std::polar(1.0, 2.0 * std::numbers::pi * std::fmod(z[i] / lsb_dps, 1.0));
      count += 1.0;
    }
  const double offset = std::arg(sum) / (2.0 * std::numbers::pi);
  return std::abs(sum) > agreed * count && std::abs(offset) > least ? offset * lsb_dps : 0.0;
}

/// Of gaps between values that a motion spreads over the grid, in ascending order: that of which
/// nearly all are multiples, begun from the smallest, or a half or a third of that; 0 where there
/// is none.
double common_step(const std::vector<double>& gaps, double resolution_dps) {
  constexpr double fewest = 50.0, most_of_them = 0.95, aside = 0.05;
  constexpr double farthest = 200.0;  // steps, after which its error adds up
  for (const double parts : {1.0, 2.0, 3.0}) {
    double step = gaps.front() / parts, products = 0.0, squares = 0.0;
    double count = 0.0, whole = 0.0;
    // A step of two or three units in which values are written is exactly so many, or none.
    const bool is_of_few = step < 4.0 * resolution_dps;
    const double units = is_of_few ? step / resolution_dps : 0.0;
    if (is_of_few && (units < 1.5 || std::abs(units - std::nearbyint(units)) > 1e-6)) return 0.0;
    for (const double gap : gaps) {
      const double steps = std::nearbyint(gap / step);
      if (steps > farthest) break;
      count += 1.0;
      if (std::abs(gap / step - steps) > aside + (is_of_few ? 0.0 : 0.6 * resolution_dps / step))
        continue;
      whole += 1.0;
      products += gap * steps;
      squares += steps * steps;
      step = products / squares;
    }
    if (count >= fewest && whole > most_of_them * count) return step;
  }
  return 0.0;
}

}  // namespace

double step_of_grid(const Simulator& simulator, const std::vector<double>& z, double noise_dps) {
  constexpr std::size_t values_inspected = 50'000;
  std::vector<double> sorted;
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first; i < span.last && sorted.size() < values_inspected; ++i)
      if (!is_missing(z[i])) sorted.push_back(z[i]);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> gaps;
  const double least = std::max(1.5 * simulator.resolution_dps(), 1e-12);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > least) gaps.push_back(sorted[i] - sorted[i - 1]);
  if (gaps.empty()) return 0.0;
  constexpr double small_to_noise = 0.1;
  if (gaps.size() > sorted.size() / 2) {
    std::sort(gaps.begin(), gaps.end());
    const double step = common_step(gaps, simulator.resolution_dps());
    return step < small_to_noise * noise_dps ? 0.0 : step;
  }
  const double step = quantile(gaps, 0.2);
  if (gaps.size() > sorted.size() / 5 && step < small_to_noise * noise_dps) return 0.0;
  double whole = 0.0;
  for (const double g : gaps)
    if (std::abs(g / step - std::nearbyint(g / step)) <
        0.05 + 0.6 * simulator.resolution_dps() / step)
      whole += 1.0;
  return whole > 0.95 * static_cast<double>(gaps.size()) ? step : 0.0;
}

double noise_of_steps(const Conditions& conditions, const std::vector<double>& z, double repeated) {
  const auto& reference = conditions.series().rate_ref_dps;
  const auto known = [&](std::size_t i) { return reference.empty() ? 0.0 : reference[i]; };
  std::vector<double> steps;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      if (const double step = z[i] - known(i) - z[i - 1] + known(i - 1); !is_missing(step))
        steps.push_back(std::abs(step));
  return steps.empty() ? 0.0
                       : quantile(std::move(steps), 0.5 * (1.0 + repeated)) /
                             (std::numbers::sqrt2 * normal_quartile);
}

Marks marks_of(const Simulator& simulator, const Series& recording) {
  Marks marks;
  const auto& z = recording.gyro_dps;
  const auto clock = slower_clock(simulator.conditions(), z);
  const double repeated = clock ? 1.0 - 1.0 / clock->samples : 0.0;
  marks.noise_of_steps_dps = noise_of_steps(simulator.conditions(), z, repeated);
  marks.lsb_dps = step_of_grid(simulator, z, marks.noise_of_steps_dps);
  if (marks.lsb_dps > 0.0)
    marks.grid_offset_dps = offset_of(simulator.conditions(), z, marks.lsb_dps);
  marks.silent =
      silent_zone(simulator.conditions(), z, std::max(marks.lsb_dps, simulator.resolution_dps()));
  double equal_at_rest = 0.0, at_rest = 0.0;
  const auto& reference = simulator.conditions().series().rate_ref_dps;
  double low = 1e300, high = -1e300;
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(z[i])) low = std::min(low, z[i]), high = std::max(high, z[i]);
  const double above = clipped_at(simulator.conditions(), z, high, low);
  const double below = clipped_at(simulator.conditions(), z, low, high);
  marks.limit_dps = std::max(above, below);
  if (marks.limit_dps > 0.0) {
    // On a side that is not clipped, what was reached is no limit.
    marks.limit_dps = above > 0.0 ? above : std::max(below, high);
    const double other = below > 0.0 ? below : std::max(above, -low);
    if (other != marks.limit_dps) marks.below_dps = other;
    marks.clipped.assign(z.size(), 0);
    for (std::size_t i = 0; i < z.size(); ++i)
      marks.clipped[i] = std::abs(z[i]) >= marks.limit_at(z[i]) ? 1 : 0;
  }
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first + 2; i < span.last; ++i) {
      constexpr double hardly = 0.05;  // of a step
      if (reference.empty() || std::abs(reference[i] - reference[i - 1]) < hardly * marks.lsb_dps) {
        at_rest += 1.0;
        equal_at_rest += z[i] == z[i - 1] ? 1.0 : 0.0;
      }
    }
  // Of a motion, neighbours are not equal whatever the noise.
  if (marks.lsb_dps > 0.0 && at_rest > 0.0)
    marks.white_under_grid_dps =
        white_under_grid(marks.lsb_dps, (equal_at_rest / at_rest - repeated) / (1.0 - repeated));
  if (const auto resting = resting_noise(simulator.conditions(), z, marks.lsb_dps)) {
    marks.level_on_grid_dps = resting->level_dps;
    marks.white_under_grid_dps = resting->std_dps;
    marks.grid_offset_dps = resting->offset_dps;
  }
  read_repeats(simulator, z, {low, high}, clock, marks);
  return marks;
}

}  // namespace gyrostat::gap
