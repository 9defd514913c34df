#include <gyrostat/diagnosis/likelihood/slower_clock.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

#include <unsupported/Eigen/FFT>

#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr double fastest = 1.02, slowest = 64.0;  // samples from one new value to the next

/// Samples of the train part whose values are not those of the one before, and how many might be.
struct Changes {
  std::vector<std::size_t> at;
  double of = 0.0;
  /// Most are by one step of a grid, and go on as the one before did, where noise goes back.
  bool follow_motion = false;
};

Changes changes_in(const Conditions& conditions, const std::vector<double>& z) {
  Changes changes;
  std::vector<double> sizes;
  double goes_on = 0.0, last = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      changes.of += 1.0;
      const double change = z[i] - z[i - 1];
      if (change == 0.0) continue;
      if (change * last > 0.0) goes_on += 1.0;
      last = change;
      changes.at.push_back(i);
      sizes.push_back(std::abs(change));
    }
  if (sizes.empty()) return changes;
  const auto count = static_cast<double>(sizes.size());
  const double one_step = 1.5 * *std::ranges::min_element(sizes);
  const auto by_one_step =
      std::ranges::count_if(sizes, [&](double size) { return size < one_step; });
  changes.follow_motion = goes_on > 0.6 * count && static_cast<double>(by_one_step) > 0.5 * count;
  return changes;
}

double turns_at(std::size_t sample, double frequency) {
  return frequency * static_cast<double>(sample);
}

/// Mean direction of the changes about the turns of a frequency (turns a sample).
std::complex<double> direction(const Changes& changes, double frequency) {
  std::complex<double> sum;
  for (const std::size_t i : changes.at)
    sum += std::polar(1.0, 2.0 * std::numbers::pi * std::remainder(turns_at(i, frequency), 1.0));
  return sum / static_cast<double>(changes.at.size());
}

/// The strongest lines of where changes are beside their mean, in turns a sample.
std::vector<double> lines_of(const Conditions& conditions, const Changes& changes) {
  constexpr std::size_t most_lines = 8;
  constexpr double clear = 30.0;  // times what changes by chance show, of which none has 20
  std::vector<double> values(std::bit_ceil(2 * conditions.size()), 0.0);
  const double mean = static_cast<double>(changes.at.size()) / changes.of;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i) values[i] = -mean;
  for (const std::size_t i : changes.at) values[i] += 1.0;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> transform;
  fft.fwd(transform, values);
  const auto bins = static_cast<double>(values.size());
  const double least = clear * static_cast<double>(changes.at.size()) * (1.0 - mean);
  std::vector<std::pair<double, double>> lines;  // power, frequency
  const auto power = [&](std::size_t k) {
    return k < transform.size() ? std::norm(transform[k]) : 0.0;
  };
  for (auto k = static_cast<std::size_t>(bins / slowest); k < transform.size(); ++k)
    if (k > 0 && power(k) >= least && power(k) >= power(k - 1) && power(k) >= power(k + 1))
      lines.emplace_back(power(k), static_cast<double>(k) / bins);
  const auto count = std::min(most_lines, lines.size());
  std::ranges::partial_sort(lines, lines.begin() + static_cast<std::ptrdiff_t>(count),
                            std::greater());
  std::vector<double> frequencies;
  for (std::size_t k = 0; k < count; ++k) frequencies.push_back(lines[k].second);
  return frequencies;
}

/// The top of a line, by thirds of what a bin is wide.
double top_of(const Changes& changes, double frequency, double bin) {
  double low = frequency - bin, high = frequency + bin;
  while (high - low > 1e-3 * bin) {
    const double third = (high - low) / 3.0;
    if (std::norm(direction(changes, low + third)) < std::norm(direction(changes, high - third)))
      low += third;
    else
      high -= third;
  }
  return 0.5 * (low + high);
}

/// Where the youngest of the new values are, after their middle.
double youngest_of(const SlowerClock& clock, const Changes& changes) {
  constexpr double first = 5e-4;
  std::vector<double> off;
  for (const std::size_t i : changes.at) off.push_back(clock.off(i));
  return quantile(std::move(off), first);
}

/// There are no more changes than new values; nearly none stands elsewhere, where many would by
/// chance; and not most where new values end, as those of a faster clock may.
bool has_all(const SlowerClock& clock, const Changes& changes) {
  constexpr double few = 0.01, of_chance = 0.05, most_at_ends = 0.25, fewest_by_chance = 50.0;
  const auto beyond = [&](double turns) {
    return static_cast<double>(std::ranges::count_if(changes.at, [&](std::size_t i) {
      return std::abs(clock.off(i)) > 0.5 / clock.samples + turns;
    }));
  };
  const auto count = static_cast<double>(changes.at.size());
  const double elsewhere = beyond(SlowerClock::uncertain);
  const double by_chance = count * (1.0 - 1.0 / clock.samples - 2.0 * SlowerClock::uncertain);
  return count * clock.samples < (1.0 + few) * changes.of && by_chance > fewest_by_chance &&
         elsewhere < few * count && elsewhere < of_chance * by_chance &&
         beyond(-SlowerClock::uncertain) < most_at_ends * count;
}

}  // namespace

double SlowerClock::off(std::size_t sample) const {
  return std::remainder(turns_at(sample, 1.0 / samples) - middle, 1.0);
}

std::optional<SlowerClock> slower_clock(const Conditions& conditions,
                                        const std::vector<double>& z) {
  constexpr std::size_t fewest = 100;
  const auto changes = changes_in(conditions, z);
  const auto count = static_cast<double>(changes.at.size());
  if (changes.at.size() < fewest || changes.follow_motion || count * fastest > changes.of)
    return std::nullopt;
  const double bin = 1.0 / static_cast<double>(conditions.size());
  std::optional<SlowerClock> found;
  for (const double line : lines_of(conditions, changes)) {
    // A clock of less than two samples shows at one turn a sample less.
    const double top = top_of(changes, line, bin);
    for (const double frequency : {top, 1.0 - top}) {
      SlowerClock clock{.samples = 1.0 / frequency};
      // Of a whole number of samples, none slips by in the recording.
      if (const double whole = std::round(clock.samples);
          std::abs(1.0 / whole - frequency) < 0.5 * bin)
        clock.samples = whole;
      if (clock.samples < std::max(fastest, found ? found->samples : 0.0) ||
          clock.samples > slowest)
        continue;
      clock.middle = std::arg(direction(changes, 1.0 / clock.samples)) / (2.0 * std::numbers::pi);
      if (!has_all(clock, changes)) continue;
      clock.youngest = youngest_of(clock, changes);
      found = clock;
    }
  }
  return found;
}

}  // namespace gyrostat::gap
