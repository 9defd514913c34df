#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/likelihood/resting_noise.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t values_inspected = 50'000;
/// A repeat is one where as many are beyond chance by so many standard deviations.
constexpr double clear = 6.0;
constexpr double least_share = 3e-4;

/// Of what changes from sample to sample beside the reference rate, robustly.
double noise_of(const Conditions& conditions, const std::vector<double>& z) {
  const auto& reference = conditions.series().rate_ref_dps;
  const auto known = [&](std::size_t i) { return reference.empty() ? 0.0 : reference[i]; };
  std::vector<double> steps;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      if (const double step = z[i] - known(i) - z[i - 1] + known(i - 1); !is_missing(step))
        steps.push_back(std::abs(step));
  return steps.empty() ? 0.0
                       : quantile(std::move(steps), 0.5) / (std::numbers::sqrt2 * normal_quartile);
}

/// The step of the values' grid, where so few values are used that they repeat, or where a motion
/// spreads values over many steps that are not small to the noise.
double grid_step(const Simulator& simulator, const std::vector<double>& z, double noise_dps) {
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
  const double step = quantile(gaps, 0.2);
  constexpr double small_to_noise = 0.1;
  if (gaps.size() > sorted.size() / 5 &&
      (gaps.size() > sorted.size() / 2 || step < small_to_noise * noise_dps))
    return 0.0;
  double whole = 0.0;
  for (const double g : gaps)
    if (std::abs(g / step - std::nearbyint(g / step)) <
        0.05 + 0.6 * simulator.resolution_dps() / step)
      whole += 1.0;
  return whole > 0.95 * static_cast<double>(gaps.size()) ? step : 0.0;
}

/// Where far more samples than beside it have the largest value, or the smallest.
double clipped_at(const Conditions& conditions, const std::vector<double>& z, double end) {
  constexpr double fewest = 8.0, beside = 4.0;
  double at_end = 0.0, next = 0.0, nearest = -1e300;
  const double sign = end > 0.0 ? 1.0 : -1.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (z[i] != end && !is_missing(z[i])) nearest = std::max(nearest, sign * z[i]);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      at_end += z[i] == end ? 1.0 : 0.0;
      next += sign * z[i] == nearest ? 1.0 : 0.0;
    }
  return at_end >= fewest && at_end > beside * next ? std::abs(end) : 0.0;
}

/// Samples that would equal the one before if none was repeated. On a fine grid as many as differ
/// from it by each of the next steps: the density of differences is level there to two percent.
/// Else by how many differ from it by one and by two steps: differences are normal.
double equal_by_chance(const std::vector<double>& differences, double step) {
  std::vector<double> sizes;
  for (const double d : differences)
    if (d != 0.0 && !is_missing(d)) sizes.push_back(std::abs(d));
  constexpr double level_within = 0.3;  // of the median
  if (const double reach = std::floor(level_within * quantile(sizes, 0.5) / step); reach >= 2.0) {
    const auto within = std::count_if(sizes.begin(), sizes.end(), [&](double size) {
      return std::nearbyint(size / step) <= reach;
    });
    return static_cast<double>(within) / (2.0 * reach);
  }
  double ones = 0.0, twos = 0.0;
  for (const double d : differences) {
    const double steps = std::abs(d) / step;
    ones += std::abs(steps - 1.0) < 0.3 ? 0.5 : 0.0;
    twos += std::abs(steps - 2.0) < 0.3 ? 0.5 : 0.0;
  }
  // On a coarser grid it matters where between two of its values the level is.
  if (twos < 50.0 || twos < 0.2 * ones) return -1.0;
  return ones * std::pow(std::max(ones / twos, 1.0), 1.0 / 3.0);
}

/// Pairs of samples between which the reference moves by more than rounding and noise could undo,
/// how many of them do not move as far, and how many are equal.
struct Apart {
  double pairs = 0.0, still = 0.0, equal = 0.0;
  /// Where the gyro only lags, they stand still without being equal.
  bool shows_repeats() const {
    constexpr double fewest = 2.0, most_of_them = 0.8;
    return equal >= fewest && equal >= most_of_them * still;
  }
};
Apart kept_apart_by_motion(const Conditions& conditions, const std::vector<double>& z,
                           const Marks& marks) {
  const auto& reference = conditions.series().rate_ref_dps;
  Apart apart;
  if (reference.empty()) return apart;
  // A filter's output has not yet begun to move where its input has.
  constexpr std::size_t around = 4;
  const auto follows = [&](std::size_t i) {
    const std::size_t from = i - 1 - around, to = i + around;
    return 2.0 * std::abs(z[to] - z[from]) >= std::abs(reference[to] - reference[from]);
  };
  const auto each = [&](const auto& look) {
    for (const auto& span : conditions.spans(Part::train))
      for (std::size_t i = span.first + 1 + around; i + around < span.last; ++i)
        if (!is_missing(z[i]) && !is_missing(z[i - 1]) && follows(i) &&
            (marks.limit_dps == 0.0 || std::abs(z[i]) < marks.limit_at(z[i])))
          look(z[i], z[i] - z[i - 1], reference[i] - reference[i - 1]);
  };
  std::vector<double> errors;
  each(
      [&](double /*z*/, double step, double turned) { errors.push_back(std::abs(step - turned)); });
  if (errors.empty()) return apart;
  constexpr double beyond_noise = 5.0;
  const double far =
      marks.lsb_dps + beyond_noise * quantile(std::move(errors), 0.5) / normal_quartile;
  each([&](double value, double step, double turned) {
    // About zero, a dead zone may hold them together.
    if (std::abs(turned) <= far || std::abs(value) <= far) return;
    apart.pairs += 1.0;
    apart.still += std::abs(step) <= far ? 1.0 : 0.0;
    apart.equal += step == 0.0 ? 1.0 : 0.0;
  });
  return apart;
}

/// Whether flags begin at distances that are alike: by chance they would spread as far as their
/// mean.
bool come_regularly(const Conditions& conditions, const std::vector<char>& flags) {
  double count = 0.0, sum = 0.0, squares = 0.0;
  for (const auto& span : conditions.spans(Part::train)) {
    std::size_t last = span.last;
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      if (flags[i] == 0 || flags[i - 1] != 0) continue;
      if (last < i) {
        const auto distance = static_cast<double>(i - last);
        count += 1.0;
        sum += distance;
        squares += distance * distance;
      }
      last = i;
    }
  }
  constexpr double fewest = 20.0, alike = 0.3;
  if (count < fewest) return false;
  const double mean = sum / count;
  return squares / count - mean * mean < alike * alike * mean * mean;
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

}  // namespace

Marks marks_of(const Simulator& simulator, const Series& recording) {
  Marks marks;
  const auto& z = recording.gyro_dps;
  marks.noise_of_steps_dps = noise_of(simulator.conditions(), z);
  marks.lsb_dps = grid_step(simulator, z, marks.noise_of_steps_dps);
  marks.silent = silent_zone(simulator.conditions(), z, marks.lsb_dps);
  const auto is_silent = [&](std::size_t i) {
    return !marks.silent.samples.empty() && z[i] == 0.0;
  };
  double equal = 0.0, twice = 0.0, count = 0.0;
  double equal_at_rest = 0.0, at_rest = 0.0;
  const auto& reference = simulator.conditions().series().rate_ref_dps;
  double low = 1e300, high = -1e300;
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(z[i])) low = std::min(low, z[i]), high = std::max(high, z[i]);
  const double above = clipped_at(simulator.conditions(), z, high);
  const double below = clipped_at(simulator.conditions(), z, low);
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
  std::vector<double> differences;
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first + 2; i < span.last; ++i) {
      count += 1.0;
      differences.push_back(z[i] - z[i - 1]);
      constexpr double hardly = 0.05;  // of a step
      if (reference.empty() || std::abs(reference[i] - reference[i - 1]) < hardly * marks.lsb_dps) {
        at_rest += 1.0;
        equal_at_rest += z[i] == z[i - 1] ? 1.0 : 0.0;
      }
      // What is clipped is not repeated.
      if (z[i] != z[i - 1] || z[i] == low || z[i] == high || is_silent(i)) continue;
      equal += 1.0;
      if (z[i - 1] == z[i - 2]) twice += 1.0;
    }
  // Of a motion, neighbours are not equal whatever the noise.
  if (marks.lsb_dps > 0.0 && at_rest > 0.0)
    marks.white_under_grid_dps = white_under_grid(marks.lsb_dps, equal_at_rest / at_rest);
  if (const auto resting = resting_noise(simulator.conditions(), z, marks.lsb_dps)) {
    marks.level_on_grid_dps = resting->level_dps;
    marks.white_under_grid_dps = resting->std_dps;
    marks.grid_offset_dps = resting->offset_dps;
  }
  double by_chance = 0.0;
  if (marks.lsb_dps > 0.0)
    by_chance = equal_by_chance(differences, marks.lsb_dps);
  else if (simulator.resolution_dps() > 0.0)
    by_chance = equal_by_chance(differences, simulator.resolution_dps());
  if (by_chance < 0.0)
    by_chance = simulator.resolution_dps() > 0.0 && marks.lsb_dps == 0.0 ? 0.0 : equal;
  // Nor where the rates between which a motion rests lie between the values of a coarse grid.
  constexpr double coarse = 2.0;
  if (!reference.empty() && marks.lsb_dps > coarse * marks.white_under_grid_dps) by_chance = equal;
  double beyond = equal - by_chance;
  // So many pairs say that there are none, too.
  constexpr double enough_pairs = 1000.0;
  if (const auto apart = kept_apart_by_motion(simulator.conditions(), z, marks);
      apart.pairs >= enough_pairs || apart.shows_repeats()) {
    marks.turns_through_grid = apart.pairs > 0.5 * count;
    beyond = apart.equal / apart.pairs * count;
    by_chance = 0.0;
  }
  if (beyond < clear * std::sqrt(by_chance + 1.0) + 0.1 * by_chance || beyond < least_share * count)
    return marks;
  // Of the repeats by chance, nearly none follow a repeat.
  const double share = std::clamp(twice / std::max(equal, 1.0), 0.0, 0.95);
  const double base = count > 0.0 ? equal / count : 0.0;
  marks.stale_run = share > 1.5 * base ? 1.0 / (1.0 - share) : 1.0;
  const double repeated = std::clamp(beyond / count, 1e-6, 0.99);
  marks.stale_probability = std::min(1.0, repeated / (marks.stale_run * (1.0 - repeated)));
  marks.repeats.assign(z.size(), 0);
  for (std::size_t i = 1; i < z.size(); ++i)
    marks.repeats[i] = z[i] == z[i - 1] && z[i] != low && z[i] != high && !is_silent(i) ? 1 : 0;
  marks.stale_is_regular = come_regularly(simulator.conditions(), marks.repeats);
  return marks;
}

}  // namespace gyrostat::gap
