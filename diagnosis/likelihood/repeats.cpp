#include <gyrostat/diagnosis/likelihood/repeats.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/equal_by_chance.hpp>
#include <gyrostat/diagnosis/likelihood/kept_apart.hpp>

namespace gyrostat::gap {
namespace {

/// A repeat is one where as many are beyond chance by so many standard deviations.
constexpr double clear = 6.0;
constexpr double least_share = 5e-5;

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
  // Where hardly any are equal by chance, all say more than a few that a motion keeps apart.
  constexpr double hardly_any = 0.05;
  const bool all_say_more = grid == 0.0 && by_chance < hardly_any * equal;
  const auto apart =
      back > 1 ? KeptApart{}
               : kept_apart_by_motion(simulator.conditions(), z, marks, simulator.resolution_dps());
  if (apart.pairs >= enough_pairs || (apart.shows_repeats() && !all_say_more)) {
    marks.turns_through_grid = apart.pairs > 0.5 * count;
    by_chance = apart.by_chance / apart.pairs * count;
    beyond = apart.equal / apart.pairs * count - by_chance;
  }
  if (beyond < clear * std::sqrt(by_chance + 1.0) + 0.1 * by_chance || beyond < least_share * count)
    return;
  // Where a fresh sample follows each repeat, only those by chance stand beside others, by as much
  // again as without repeats at the most.
  constexpr double enough_repeats = 20.0;
  const bool are_apart = apart.in_a_row >= enough_repeats;
  const double follow =
      are_apart ? apart.both_equal / apart.in_a_row : twice / std::max(equal, 1.0);
  const double chance = are_apart ? apart.by_chance / apart.pairs
                                  : std::max(0.0, equal - beyond) / std::max(count, 1.0);
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

/// One repeat follows each new value, or so many do as there is time for.
void read_repeats(const SlowerClock& clock, const std::vector<double>& z, Marks& marks) {
  const double of_each = clock.samples - 1.0;
  marks.stale_run = std::max(1.0, of_each);
  marks.stale_probability = of_each / marks.stale_run;
  marks.stale_is_regular = true;
  marks.repeats.assign(z.size(), 0);
  for (std::size_t i = 1; i < z.size(); ++i)
    marks.repeats[i] = z[i] == z[i - 1] && !clock.is_new_at(i) ? 1 : 0;
}

}  // namespace

void read_repeats(const Simulator& simulator, const std::vector<double>& values, const Ends& ends,
                  const std::optional<SlowerClock>& clock, Marks& marks) {
  if (clock) return read_repeats(*clock, values, marks);
  constexpr std::size_t oldest = 4;
  for (std::size_t back = 1; back <= oldest && marks.repeats.empty(); ++back)
    read_repeats(simulator, values, ends, back, marks);
}

}  // namespace gyrostat::gap
