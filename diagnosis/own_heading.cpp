#include <gyrostat/diagnosis/own_heading.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/starts/turning.hpp>

namespace gyrostat::gap {
namespace {

/// The heading without wraps; missing where it is.
std::vector<double> unwrapped(const std::vector<double>& heading_deg) {
  std::vector<double> turned(heading_deg.size(), no_value);
  double last = no_value, sum = 0.0;
  for (std::size_t i = 0; i < heading_deg.size(); ++i) {
    if (is_missing(heading_deg[i])) continue;
    if (!is_missing(last)) sum += wrap_degrees(heading_deg[i] - last);
    last = heading_deg[i];
    turned[i] = sum;
  }
  return turned;
}

/// Products of two changes over the same second, summed.
struct Shared {
  double squares = 0.0, other_squares = 0.0, products = 0.0;
  void add(double x, double y) {
    squares += x * x;
    other_squares += y * y;
    products += x * y;
  }
  double slope() const { return products / squares; }
  double correlation() const { return products / std::sqrt(squares * other_squares); }
};

/// How a rate goes with the heading's turning, in steps of a second.
Shared shared(const Series& recording, const std::vector<double>& turned,
              const std::vector<double>& rate_dps) {
  Shared sums;
  const auto block = static_cast<std::size_t>(std::max(1.0, std::round(recording.rate_hz())));
  for (std::size_t first = 0; first + block < turned.size(); first += block) {
    double sum_deg = 0.0;
    for (std::size_t i = first; i < first + block; ++i)
      sum_deg += rate_dps[i] * (recording.t_s[i + 1] - recording.t_s[i]);
    const double change_deg = turned[first + block] - turned[first];
    if (!is_missing(change_deg) && !is_missing(sum_deg)) sums.add(change_deg, sum_deg);
  }
  return sums;
}

bool is_of_another_axis(const Series& recording, const std::vector<double>& turned) {
  constexpr double alike = 0.9, most_misaligned = 0.1;
  const auto own = shared(recording, turned, recording.gyro_dps);
  if (!(own.squares > 0.0) || std::abs(own.slope()) >= most_misaligned) return false;
  return std::ranges::any_of(
      std::initializer_list{&recording.cross_rate_1_dps, &recording.cross_rate_2_dps},
      [&](const auto* cross) {
        return !cross->empty() && std::abs(shared(recording, turned, *cross).correlation()) > alike;
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
