#include <gyrostat/diagnosis/likelihood/repeats.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/equal_by_chance.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// A repeat is one where as many are beyond chance by so many standard deviations.
constexpr double clear = 6.0;
constexpr double least_share = 5e-5;

/// Pairs of samples between which the reference moves by more than rounding and noise could undo,
/// how many of them do not move as far, and how many are equal, or would be by chance: outliers
/// fall on the value before as they do on those on either side of it, where a filter that follows
/// the motion falls on one side alone.
struct Apart {
  double pairs = 0.0, still = 0.0, equal = 0.0, by_chance = 0.0;
  double far_dps = 0.0;  ///< what neither undoes
  double spread_dps = 0.0, grid_dps = 0.0;
  /// From which step of the reference on equal neighbours may well be repeated, as this share of
  /// samples is: at odds of a tenth against being rounded to the same value of a grid. What is
  /// hidden in vain is little noise the less, what is not is an outlier the more.
  double told_from_dps(double repeated) const {
    constexpr double odds = 0.1;
    const double by_rounding =
        grid_dps / (std::sqrt(2.0 * std::numbers::pi) * std::max(spread_dps, 1e-12));
    const double log_odds = std::log(odds * by_rounding / std::max(repeated, 1e-12));
    return std::min(far_dps, spread_dps * std::sqrt(2.0 * std::max(0.0, log_odds)));
  }
  /// Where the gyro only lags, they stand still without being equal.
  bool shows_repeats() const {
    constexpr double fewest = 2.0, most_of_them = 0.8;
    return equal >= fewest && equal >= most_of_them * still;
  }
};
Apart kept_apart_by_motion(const Conditions& conditions, const std::vector<double>& z,
                           const Marks& marks, double resolution_dps) {
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
          look(i, z[i] - z[i - 1], reference[i] - reference[i - 1]);
  };
  std::vector<double> errors;
  each([&](std::size_t /*i*/, double step, double turned) {
    errors.push_back(std::abs(step - turned));
  });
  if (errors.empty()) return apart;
  constexpr double beyond_noise = 5.0;
  // Most of a coarse grid's errors are 0, whatever the noise under it.
  const double spread = std::max(quantile(std::move(errors), 0.5) / normal_quartile,
                                 std::numbers::sqrt2 * marks.white_under_grid_dps);
  const double far = apart.far_dps = marks.lsb_dps + beyond_noise * spread;
  const double grid = marks.lsb_dps > 0.0 ? marks.lsb_dps : resolution_dps;
  apart.spread_dps = spread;
  apart.grid_dps = grid;
  constexpr double beside = 2.0;  // steps
  double back = 0.0, forth = 0.0;
  const double widest_zone_dps = 0.5 * fastest_dps(conditions);
  each([&](std::size_t i, double step, double turned) {
    // About zero, a dead zone may hold them together.
    const bool may_be_held = std::abs(z[i]) <= far && std::abs(reference[i]) <= widest_zone_dps;
    if (std::abs(turned) <= far || may_be_held) return;
    apart.pairs += 1.0;
    apart.still += std::abs(step) <= far ? 1.0 : 0.0;
    apart.equal += step == 0.0 ? 1.0 : 0.0;
    if (step != 0.0 && std::abs(step) < (beside + 0.5) * grid)
      (step * turned < 0.0 ? back : forth) += 1.0;
  });
  apart.by_chance = std::sqrt(back * forth) / beside;
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

/// How many of all pairs are as equal that stand farther apart than a value is repeated: a grid
/// that is there for a part of the recording alone, as where a rotation of three axes stands still,
/// makes them so.
double share_equal_far_apart(const Conditions& conditions, const std::vector<double>& z,
                             const auto& is_free) {
  constexpr std::size_t nearest = 256, farthest = 264;
  double equal = 0.0, count = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t lag = nearest; lag < farthest; ++lag)
      for (std::size_t i = span.first + lag; i < span.last; ++i) {
        count += 1.0;
        if (z[i] == z[i - lag] && is_free(z[i])) equal += 1.0;
      }
  return count > 0.0 ? equal / count : 0.0;
}

/// Those that are as old; none for older ones where a grid makes values equal.
void read_repeats(const Simulator& simulator, const std::vector<double>& z, const Ends& ends,
                  std::size_t back, Marks& marks) {
  // What is clipped or below a threshold is not repeated.
  const auto is_silent = [&](double value) {
    return !marks.silent.samples.empty() && value == 0.0;
  };
  const auto is_free = [&](double value) { return !ends.holds(value) && !is_silent(value); };
  double equal = 0.0, twice = 0.0, count = 0.0;
  std::vector<double> differences;
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first + back + 1; i < span.last; ++i) {
      count += 1.0;
      differences.push_back(z[i] - z[i - back]);
      if (z[i] != z[i - back] || !is_free(z[i])) continue;
      equal += 1.0;
      if (z[i - 1] == z[i - 1 - back]) twice += 1.0;
    }
  const double grid = marks.lsb_dps > 0.0 ? marks.lsb_dps : step_of_moved_grid(differences);
  if (back > 1 && grid > 0.0) return;
  double by_chance = 0.0;
  if (grid > 0.0)
    by_chance = equal_by_chance(differences, grid);
  else if (simulator.resolution_dps() > 0.0)
    by_chance = equal_by_chance(differences, simulator.resolution_dps());
  if (by_chance < 0.0) by_chance = simulator.resolution_dps() > 0.0 && grid == 0.0 ? 0.0 : equal;
  // Nor where the rates between which a motion rests lie between the values of a coarse grid.
  constexpr double coarse = 2.0;
  if (!simulator.conditions().series().rate_ref_dps.empty() &&
      marks.lsb_dps > coarse * std::max(marks.white_under_grid_dps, marks.noise_of_steps_dps))
    by_chance = equal;
  // Where no grid says so, as many of those that are not repeated are equal as of pairs far apart.
  if (const double apart_equal =
          grid > 0.0 ? 0.0 : share_equal_far_apart(simulator.conditions(), z, is_free);
      apart_equal < 1.0)
    by_chance = std::max(by_chance, (count - equal) * apart_equal / (1.0 - apart_equal));
  double beyond = equal - by_chance;
  // So many pairs say that there are none, too.
  constexpr double enough_pairs = 1000.0;
  const auto apart =
      back > 1 ? Apart{}
               : kept_apart_by_motion(simulator.conditions(), z, marks, simulator.resolution_dps());
  if (apart.pairs >= enough_pairs || apart.shows_repeats()) {
    marks.turns_through_grid = apart.pairs > 0.5 * count;
    by_chance = apart.by_chance / apart.pairs * count;
    beyond = apart.equal / apart.pairs * count - by_chance;
  }
  if (beyond < clear * std::sqrt(by_chance + 1.0) + 0.1 * by_chance || beyond < least_share * count)
    return;
  // Where a fresh sample follows each repeat, only those by chance stand beside others, by as much
  // again as without repeats at the most.
  const double follow = twice / std::max(equal, 1.0);
  const double chance = std::max(0.0, equal - beyond) / std::max(count, 1.0);
  marks.stale_run = follow > 2.0 * chance ? 1.0 / (1.0 - std::min(follow - chance, 0.95)) : 1.0;
  const double repeated = std::clamp(beyond / count, 1e-6, 0.99);
  marks.stale_probability = std::min(1.0, repeated / (marks.stale_run * (1.0 - repeated)));
  marks.repeats.assign(z.size(), 0);
  // Where most equal neighbours are so by chance, those are flagged that a motion keeps apart:
  // without all of them the noise would be another.
  marks.repeats_are_told = beyond >= 0.5 * equal;
  const auto& reference = simulator.conditions().series().rate_ref_dps;
  const double told_from_dps = apart.told_from_dps(repeated);
  const auto is_told = [&](std::size_t i) {
    return marks.repeats_are_told ||
           (!reference.empty() && std::abs(reference[i] - reference[i - 1]) > told_from_dps);
  };
  const auto is_clipped = [&](std::size_t i) {
    return ends.holds(z[i]) &&
           (reference.empty() || std::abs(reference[i]) > std::abs(z[i]) - apart.far_dps);
  };
  for (std::size_t i = back; i < z.size(); ++i)
    marks.repeats[i] =
        z[i] == z[i - back] && !is_clipped(i) && !is_silent(z[i]) && is_told(i) ? 1 : 0;
  marks.stale_back = back;
  marks.stale_is_regular = come_regularly(simulator.conditions(), marks.repeats);
}

}  // namespace

void read_repeats(const Simulator& simulator, const std::vector<double>& values, const Ends& ends,
                  Marks& marks) {
  constexpr std::size_t oldest = 4;
  for (std::size_t back = 1; back <= oldest && marks.repeats.empty(); ++back)
    read_repeats(simulator, values, ends, back, marks);
}

}  // namespace gyrostat::gap
