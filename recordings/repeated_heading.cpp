#include <gyrostat/recordings/repeated_heading.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/values.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t fewest = 20;  // repeats, below which nothing is concluded

/// Whether a sample has the values of the one before.
using Repeats = std::vector<bool>;

std::size_t count(const Repeats& repeats) {
  return static_cast<std::size_t>(std::ranges::count(repeats, true));
}

Repeats repeats_of(const std::vector<double>& values) {
  Repeats repeats(values.size(), false);
  for (std::size_t i = 1; i < values.size(); ++i) repeats[i] = values[i] == values[i - 1];
  return repeats;
}

/// A recorder's repeats are about equally long; those of a rest or of a compass that froze are
/// not, and must not be most of them.
bool are_regular(const Repeats& repeats) {
  const double runs = static_cast<double>(repeats.size() - count(repeats));
  const double longest = 4.0 * static_cast<double>(repeats.size()) / runs;
  std::size_t in_long_runs = 0, run = 0;
  for (std::size_t i = 0; i <= repeats.size(); ++i) {
    if (i < repeats.size() && repeats[i]) {
      ++run;
      continue;
    }
    if (static_cast<double>(run) > longest) in_long_runs += run;
    run = 0;
  }
  return 10 * in_long_runs < count(repeats);
}

/// Components that are coarse repeat each for itself, and all at once by chance alone; a
/// recorder's repeat together.
Repeats at_once(const MagneticField& field) {
  const auto size = static_cast<double>(field.front().size());
  Repeats all(field.front().size(), true);
  double by_chance = 1.0, least = 1.0;
  for (const auto& component : field) {
    const auto repeats = repeats_of(component);
    const double share = static_cast<double>(count(repeats)) / size;
    by_chance *= share;
    least = std::min(least, share);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] && repeats[i];
  }
  const double share = static_cast<double>(count(all)) / size;
  if (share - by_chance <= 0.25 * (least - by_chance)) all.assign(all.size(), false);
  return all;
}

/// Headings on a grid repeat by chance about as often as they go to one of their neighbours, and at
/// rest hardly go further.
Repeats beyond_chance(const std::vector<double>& heading_deg) {
  auto repeats = repeats_of(heading_deg);
  std::vector<double> steps;
  for (std::size_t i = 1; i < heading_deg.size(); ++i)
    if (const double step = std::abs(heading_deg[i] - heading_deg[i - 1]); step > 0.0)
      steps.push_back(step);
  if (steps.empty()) return Repeats(repeats.size(), false);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  // Where the grid is finer than a tenth of the usual step, steps below that are at least as likely
  // as no step.
  const double small = 0.1 * *middle;
  const auto smaller = static_cast<std::size_t>(
      std::ranges::count_if(steps, [&](double step) { return step < small; }));
  if (smaller == 0 || count(repeats) <= 2 * smaller) repeats.assign(repeats.size(), false);
  return repeats;
}

}  // namespace

std::size_t leave_out_repeats(std::vector<double>& heading_deg, const MagneticField& field) {
  const bool has_field = std::ranges::none_of(field, [](const auto& component) {
    return std::ranges::all_of(component, [](double value) { return std::isnan(value); });
  });
  const auto repeats = has_field ? at_once(field) : beyond_chance(heading_deg);
  if (count(repeats) < fewest || !are_regular(repeats)) return 0;
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < repeats.size(); ++i)
    if (repeats[i] && !std::isnan(heading_deg[i])) {
      heading_deg[i] = no_value;
      ++left_out;
    }
  return left_out;
}

}  // namespace gyrostat
