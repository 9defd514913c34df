#include <gyrostat/diagnosis/own_heading.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <gyrostat/core/heading_turns.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/turning.hpp>

namespace gyrostat::gap {
namespace {

bool is_of_another_axis(const Series& recording, const std::vector<double>& turned) {
  constexpr double alike = 0.9, most_misaligned = 0.1;
  const auto own = turns_together(recording, turned, recording.gyro_dps);
  if (!(own.heading_squares > 0.0) || std::abs(own.slope()) >= most_misaligned) return false;
  return std::ranges::any_of(
      std::initializer_list{&recording.cross_rate_1_dps, &recording.cross_rate_2_dps},
      [&](const auto* cross) {
        return !cross->empty() &&
               std::abs(turns_together(recording, turned, *cross).correlation()) > alike;
      });
}

/// Mean square of the changes over `lag` samples.
double mean_square_change(const std::vector<double>& values, std::size_t lag) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = lag; i < values.size(); ++i) {
    const double change = values[i] - values[i - lag];
    if (is_missing(change)) continue;
    sum += change * change;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// What the white noise of a rate turns in one step: of second differences it is a sixth.
double turned_by_noise(const std::vector<double>& rate_dps, double interval_s) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 2; i < rate_dps.size(); ++i) {
    const double bend = rate_dps[i] - 2.0 * rate_dps[i - 1] + rate_dps[i - 2];
    if (is_missing(bend)) continue;
    sum += bend * bend;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count / 6.0) * interval_s : 0.0;
}

bool is_of_a_filter(const Series& recording, const std::vector<double>& turned) {
  constexpr std::size_t later = 64;   // samples, after which white noise has grown by nothing
  constexpr double grown = 8.0;       // and a walk 64 times, or 13 where it is rounded
  constexpr double as_little = 10.0;  // times what the gyro's noise turns
  const double interval_s = 1.0 / recording.rate_hz();
  double noise_deg = 0.0;
  for (const auto* rate :
       {&recording.gyro_dps, &recording.cross_rate_1_dps, &recording.cross_rate_2_dps})
    noise_deg = std::max(noise_deg, turned_by_noise(*rate, interval_s));
  const double step = mean_square_change(turned, 1);
  return step > 0.0 && std::sqrt(step) < as_little * noise_deg &&
         mean_square_change(turned, later) > grown * step;
}

}  // namespace

HeadingOf heading_of(const Series& recording) {
  if (recording.heading_deg.empty() || recording.size() < 2) return HeadingOf::compass;
  const auto turned = unwrapped(recording.heading_deg);
  if (is_of_another_axis(recording, turned)) return HeadingOf::another_axis;
  // At a slow turn a heading without noise moves as little.
  if (inner_extent(recording.rate_ref_dps) == 0.0 && is_of_a_filter(recording, turned))
    return HeadingOf::filter;
  return HeadingOf::compass;
}

Series without_foreign_heading(Series recording, std::vector<std::string>& told) {
  const auto found = heading_of(recording);
  if (found == HeadingOf::compass) return recording;
  told.emplace_back(
      found == HeadingOf::filter
          ? "heading_deg walks as an integrated gyro does and has no compass's noise: a filter "
            "made it, and it is left out"
          : "heading_deg turns with another axis, and is left out");
  recording.heading_deg.clear();
  recording.mag_valid.clear();
  return recording;
}

}  // namespace gyrostat::gap
