#include <gyrostat/diagnosis/handling.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr double run_s = 0.1;
constexpr std::size_t shortest_run = 8;
constexpr double loud = 5.0;            // times the median
constexpr double longest_share = 0.05;  // of the recording

/// Root mean square deviation of samples [first, first + count) from their straight line; NaN where
/// one is missing.
double deviation_from_line(const std::vector<double>& x, std::size_t first, std::size_t count) {
  const double middle = 0.5 * static_cast<double>(count - 1);
  double mean = 0.0, slope = 0.0, squares = 0.0, spread = 0.0;
  for (std::size_t i = 0; i < count; ++i) mean += x[first + i] / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) - middle, off = x[first + i] - mean;
    slope += at * off;
    spread += at * at;
    squares += off * off;
  }
  return std::sqrt(std::max(0.0, squares - slope * slope / spread) /
                   static_cast<double>(count - 2));
}

/// Which runs of a channel are loud.
std::vector<char> loud_runs(const std::vector<double>& x, std::size_t length) {
  std::vector<double> deviations, known;
  for (std::size_t first = 0; first + length <= x.size(); first += length) {
    deviations.push_back(deviation_from_line(x, first, length));
    if (!is_missing(deviations.back())) known.push_back(deviations.back());
  }
  std::vector<char> is_loud(deviations.size(), 0);
  if (known.empty()) return is_loud;
  const double limit = loud * quantile(std::move(known), 0.5);
  for (std::size_t k = 0; k < is_loud.size(); ++k)
    is_loud[k] = limit > 0.0 && deviations[k] > limit ? 1 : 0;
  return is_loud;
}

}  // namespace

Handling handling_of(const Series& recording) {
  if (!recording.rate_ref_dps.empty() || recording.size() < 100 * shortest_run) return {};
  const double rate_hz = static_cast<double>(recording.size() - 1) / recording.duration_s();
  const std::size_t length =
      std::max(shortest_run, static_cast<std::size_t>(std::lround(run_s * rate_hz)));
  std::vector<char> is_loud(recording.size() / length, 0);
  for (const auto channel :
       {&Series::gyro_dps, &Series::cross_rate_1_dps, &Series::cross_rate_2_dps}) {
    const auto runs = loud_runs(recording.*channel, length);
    for (std::size_t k = 0; k < std::min(runs.size(), is_loud.size()); ++k) is_loud[k] |= runs[k];
  }
  const auto quiet = [](char c) { return c == 0; };
  const auto first = std::find_if(is_loud.begin(), is_loud.end(), quiet);
  const auto last = std::find_if(is_loud.rbegin(), is_loud.rend(), quiet).base();
  const auto before = static_cast<std::size_t>(first - is_loud.begin());
  const auto after = static_cast<std::size_t>(is_loud.end() - last);
  const bool elsewhere = first < last && std::any_of(first, last, [](char c) { return c != 0; });
  const double share =
      static_cast<double>((before + after) * length) / static_cast<double>(recording.size());
  if (elsewhere || before + after == 0 || share > longest_share) return {};
  // With the run beside it: a movement begins softly.
  const auto seconds = [&](std::size_t runs, std::size_t rest) {
    return runs == 0 ? 0.0 : static_cast<double>((runs + 1) * length + rest) / rate_hz;
  };
  return {seconds(before, 0), seconds(after, recording.size() - is_loud.size() * length)};
}

Series without_handling(Series recording, std::vector<std::string>& told) {
  const auto handling = handling_of(recording);
  const auto tell = [&](std::string_view end, double seconds) {
    if (seconds > 0.0)
      told.push_back(
          fmt::format("the {} {:.2g} s are left out: the sensor was moved", end, seconds));
  };
  tell("first", handling.first_s);
  tell("last", handling.last_s);
  if (handling.first_s + handling.last_s == 0.0) return recording;
  return cut(recording, handling.first_s, recording.duration_s() - handling.last_s, "handling");
}

}  // namespace gyrostat::gap
