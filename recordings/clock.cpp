#include <gyrostat/recordings/clock.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {
namespace {

constexpr double largest_error = 0.1;     // of an interval, for an even clock
constexpr double largest_fraction = 0.3;  // of an interval, beside a whole number of them
constexpr std::size_t one_in = 100;       // intervals that may be off, after a gap
constexpr double largest_drift = 2e-3;    // of the duration, off the even clock
constexpr double bounded = 0.25;          // of what a random walk's scatter would be
constexpr std::size_t most_ticks = std::size_t{1} << 27, fewest_samples_one_in = 500;

/// The tick of every sample; they do not decrease.
using Ticks = std::vector<std::uint32_t>;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// t = at_first + interval · tick.
struct Line {
  double at_first = 0.0, interval = 0.0, rms = 0.0, worst = 0.0;
};

/// A robust line through times over their ticks.
Line robust_line(const std::vector<double>& t_s, const Ticks& ticks) {
  const std::size_t n = t_s.size(), third = n / 3, step = std::max<std::size_t>(1, n >> 20);
  const auto tick = [&](std::size_t i) {
    return static_cast<double>(ticks.empty() ? i : ticks[i]);
  };
  std::vector<double> slopes, offsets;
  for (std::size_t i = 0; i + third < n; i += step)
    slopes.push_back((t_s[i + third] - t_s[i]) / (tick(i + third) - tick(i)));
  Line line{.interval = median(slopes)};
  for (std::size_t i = 0; i < n; i += step) offsets.push_back(t_s[i] - line.interval * tick(i));
  line.at_first = median(offsets);
  for (std::size_t i = 0; i < n; ++i) {
    const double off = t_s[i] - line.at_first - line.interval * tick(i);
    line.rms += off * off / static_cast<double>(n);
    line.worst = std::max(line.worst, std::abs(off));
  }
  line.rms = std::sqrt(line.rms);
  return line;
}

/// The tick of every sample where dropped samples are all that is uneven.
std::optional<Ticks> ticks_with_gaps(const std::vector<double>& t_s) {
  const double step = median_interval(t_s);
  Ticks ticks(t_s.size(), 0);
  std::size_t off = 0;
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double steps = (t_s[i] - t_s[i - 1]) / step;
    const double whole = std::max(1.0, std::round(steps));
    if (std::abs(steps - whole) > largest_fraction) ++off;
    if (off * one_in > t_s.size() || whole > static_cast<double>(most_ticks)) return std::nullopt;
    ticks[i] = ticks[i - 1] + static_cast<std::uint32_t>(whole);
    if (ticks[i] >= most_ticks) return std::nullopt;
  }
  return ticks;
}

/// Whether times keep to a line over the samples' number.
bool keeps_to(const Line& line, const std::vector<double>& t_s) {
  double square = 0.0;
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double off = t_s[i] - t_s[i - 1] - line.interval;
    square += off * off;
  }
  // A random walk of these steps, tied to a line, scatters by about the root of n / 6 of them.
  return line.rms * line.rms < bounded * bounded * square / 6.0;
}

bool is_continuous(const Channel& channel) {
  return channel.values != &Series::gyro_dps && channel.values != &Series::heading_deg &&
         channel.values != &Series::t_s;
}

/// The mean of a channel's samples at each tick; what the sensor goes through is bridged where
/// there is none.
std::vector<double> at_ticks(const std::vector<double>& from, const Ticks& ticks,
                             const Channel& channel) {
  std::vector<double> to(ticks.back() + std::size_t{1}, no_value);
  for (std::size_t i = 0; i < from.size();) {
    double sum = 0.0, last = 0.0;
    std::size_t count = 0, k = i;
    for (; k < from.size() && ticks[k] == ticks[i]; ++k)
      if (!std::isnan(from[k])) {
        sum += last = from[k];
        ++count;
      }
    if (count == 1 || channel.values == &Series::heading_deg)
      sum = last;
    else if (count > 0)
      sum /= static_cast<double>(count);
    if (channel.values == &Series::mag_valid && count > 0) sum = std::round(sum);
    if (count > 0) to[ticks[i]] = sum;
    i = k;
  }
  if (!is_continuous(channel)) return to;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const double before = to[ticks[i - 1]], after = to[ticks[i]];
    const auto gap = static_cast<double>(ticks[i] - ticks[i - 1]);
    for (std::size_t k = ticks[i - 1] + std::size_t{1}; k < ticks[i]; ++k) {
      const double share = static_cast<double>(k - ticks[i - 1]) / gap;
      to[k] = channel.values == &Series::mag_valid ? before : before + share * (after - before);
    }
  }
  return to;
}

/// Every channel but the times, which are lost: a long recording has no room for both clocks.
void put_at_ticks(Series& series, const Ticks& ticks) {
  series.t_s = {};
  for (const auto& channel : channels)
    if (auto& values = series.*channel.values; !values.empty())
      values = at_ticks(values, ticks, channel);
}

void set_times(Series& series, std::size_t size, double first, double interval) {
  series.t_s.resize(size);
  for (std::size_t i = 0; i < size; ++i) series.t_s[i] = first + interval * static_cast<double>(i);
}

double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

EvenRecording resampled(Series series, std::string_view place, double rate_hz) {
  const std::size_t n = series.size();
  const double first = series.t_s.front();
  const double last_tick = std::round((series.t_s.back() - first) * rate_hz);
  if (last_tick >= static_cast<double>(most_ticks))
    throw InputError(place, fmt::format("--resample {:g}: {:.4g} samples; allowed: up to {}",
                                        rate_hz, last_tick + 1, most_ticks));
  Ticks ticks(n);
  double square = 0.0;
  std::size_t filled = 0, shared = 0;
  for (std::size_t i = 0, with = 0; i < n; ++i) {
    const double at = (series.t_s[i] - first) * rate_hz;
    ticks[i] = static_cast<std::uint32_t>(std::round(at));
    square += std::pow(at - std::round(at), 2) / static_cast<double>(n);
    const bool is_new = i == 0 || ticks[i] != ticks[i - 1];
    with = is_new ? 1 : with + 1;
    filled += is_new ? 1 : 0;
    shared += with == 2 ? 1 : 0;
  }
  const std::size_t size = ticks.back() + std::size_t{1};
  put_at_ticks(series, ticks);
  EvenRecording even{std::move(series), {}};
  set_times(even.series, size, first, 1.0 / rate_hz);
  even.note = fmt::format(
      "put on a clock of {:.6g} Hz: {:.2g} % of {} ticks have no sample, {:.2g} % the mean of "
      "several, whose "
      "white noise is smaller by the root of their number; samples moved by {:.2g} ms rms",
      rate_hz, percent(size - filled, size), size, percent(shared, size),
      1e3 * std::sqrt(square) / rate_hz);
  return even;
}

}  // namespace

double median_interval(const std::vector<double>& t_s) {
  const std::size_t step = std::max<std::size_t>(1, t_s.size() >> 22);
  std::vector<double> intervals;
  intervals.reserve(t_s.size() / step + 1);
  for (std::size_t i = 1; i < t_s.size(); i += step) intervals.push_back(t_s[i] - t_s[i - 1]);
  return intervals.empty() ? 0.0 : median(std::move(intervals));
}

void require_dense(const Series& series, std::string_view place, double from_s) {
  constexpr std::size_t one_sample_in = 4, long_pause = 50, fewest_means = 50;
  struct Burst {
    std::size_t first, last, samples;
  };
  std::vector<Burst> bursts;
  std::size_t present = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (std::isnan(series.gyro_dps[i])) continue;
    if (bursts.empty() || i - bursts.back().last > long_pause) bursts.push_back({i, i, 0});
    bursts.back().last = i;
    ++bursts.back().samples;
    ++present;
  }
  if (present * one_sample_in >= series.size()) return;
  if (bursts.empty()) throw InputError(place, "has no sample there: the recording pauses");
  const auto longest = std::ranges::max_element(bursts, {}, &Burst::samples);
  const double start = from_s + series.t_s[longest->first] - series.t_s.front();
  const double end = from_s + series.t_s[longest->last] - series.t_s.front();
  throw InputError(
      place,
      fmt::format(
          "is {} bursts at {:.4g} Hz: {:.2g} % of that clock's samples are there, at least 25 % "
          "are needed. The longest burst has {} samples, from {:.6g} to {:.6g} s: take it or "
          "another by --from and --to{}; gyrostat allan takes them all",
          bursts.size(), series.rate_hz(), percent(present, series.size()), longest->samples,
          std::floor(10.0 * start) / 10.0, std::ceil(10.0 * end) / 10.0,
          bursts.size() < fewest_means
              ? std::string()
              : fmt::format(", or a mean of each: --resample {:.2g}",
                            static_cast<double>(bursts.size() - 1) / series.duration_s())));
}

bool is_even(const std::vector<double>& t_s) {
  const double step = median_interval(t_s);
  for (std::size_t i = 1; i < t_s.size(); ++i)
    if (std::abs(t_s[i] - t_s[i - 1] - step) > largest_error * step) return false;
  return true;
}

EvenRecording evenly_sampled(Series series, std::string_view place, std::size_t first_row,
                             double resample_hz) {
  const std::size_t n = series.size();
  if (n < 3) return {std::move(series), {}};
  if (resample_hz > 0.0) return resampled(std::move(series), place, resample_hz);
  if (is_even(series.t_s)) return {std::move(series), {}};

  if (const auto ticks = ticks_with_gaps(series.t_s)) {
    const std::size_t size = ticks->back() + std::size_t{1};
    const auto line = robust_line(series.t_s, *ticks);
    const double allowed = std::max(line.interval, largest_drift * series.duration_s());
    if (size / fewest_samples_one_in <= n && line.worst <= allowed) {
      put_at_ticks(series, *ticks);
      EvenRecording even{std::move(series), {}};
      set_times(even.series, size, line.at_first, line.interval);
      even.note = fmt::format(
          "{} of {} samples at {:.6g} Hz are missing; times are off the even clock by {:.2g} ms "
          "rms, "
          "{:.2g} ms at most",
          size - n, size, 1.0 / line.interval, 1e3 * line.rms, 1e3 * line.worst);
      return even;
    }
  }
  const auto line = robust_line(series.t_s, {});
  if (line.interval > 0.0 && keeps_to(line, series.t_s)) {
    set_times(series, n, line.at_first, line.interval);
    return {
        std::move(series),
        fmt::format("samples are regular, their stamps are not: taken at {:.6g} Hz, off which the "
                    "stamps are by {:.2g} ms rms, {:.2g} ms at most",
                    1.0 / line.interval, 1e3 * line.rms, 1e3 * line.worst)};
  }
  const double step = median_interval(series.t_s);
  std::size_t off = 0, first_off = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (std::abs(series.t_s[i] - series.t_s[i - 1] - step) > largest_error * step && off++ == 0)
      first_off = i;
  throw InputError(
      sample_place(place, first_row, first_off),
      fmt::format(
          "comes {:.6g} s after the sample before it, where the median is {:.6g} s ({} of {} "
          "intervals are more than 10 % off it, by no whole number): the rate changes. "
          "--resample {:.3g} puts the samples on an even clock",
          series.t_s[first_off] - series.t_s[first_off - 1], step, off, n - 1, 1.0 / step));
}

}  // namespace gyrostat
