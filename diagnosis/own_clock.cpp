#include <gyrostat/diagnosis/own_clock.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/gap/distinct_values.hpp>
#include <gyrostat/diagnosis/likelihood/slower_clock.hpp>
#include <gyrostat/diagnosis/views.hpp>

namespace gyrostat::gap {
namespace {

/// So much of a sample after its number, below 0 by 1 at the most: through both neighbours, with
/// the slopes of theirs (cubic convolution, Keys, IEEE Trans. ASSP 29, 1981).
double between(const std::vector<double>& values, std::size_t sample, double after) {
  const double x = 1.0 + after;
  const auto at = [&](std::size_t i) { return values[std::min(i, values.size() - 1)]; };
  const double from = at(sample - 1), to = at(sample), rise = to - from;
  const double slope = 0.5 * (to - at(sample < 2 ? 0 : sample - 2)) - rise;
  const double next = 0.5 * (at(sample + 1) - from) - rise;
  return from + x * rise + x * (1.0 - x) * ((1.0 - x) * slope - x * next);
}

}  // namespace

Series at_the_recorders_times(Series recording, std::vector<std::string>& told) {
  const auto& reference = recording.rate_ref_dps;
  if (reference.empty() ||
      std::ranges::any_of(reference, [](double rate) { return is_missing(rate); }))
    return recording;
  auto& gyro = recording.gyro_dps;
  const auto clock = slower_clock(Conditions(recording, Split::none), gyro);
  if (!clock || clock->samples == std::round(clock->samples)) return recording;
  constexpr double nearly_all = 0.9;
  const double values = static_cast<double>(gyro.size()) / clock->samples;
  if (static_cast<double>(distinct_values(gyro)) < nearly_all * values) return recording;
  double moved = 0.0, before = gyro.front();
  for (std::size_t i = 1; i < gyro.size(); ++i) {
    if (gyro[i] != before) moved = reference[i] - between(reference, i, -clock->age(i));
    before = gyro[i];
    gyro[i] += moved;
  }
  told.push_back(fmt::format(
      "the gyro has a new value each {:.5g} samples, at times of its own: values are moved to the "
      "times that they are written at, by what the reference turned meanwhile",
      clock->samples));
  return recording;
}

}  // namespace gyrostat::gap
