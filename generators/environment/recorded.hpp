#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// A channel of a recording, counted from its first sample: linear between samples, held before and
/// after. Every sample has a value.
inline double recorded_at(const Series& recording, const std::vector<double>& channel, double t_s) {
  const auto& t = recording.t_s;
  const double at = t.front() + t_s;
  const auto after = std::upper_bound(t.begin(), t.end(), at) - t.begin();
  if (after == 0) return channel.front();
  if (after == std::ssize(t)) return channel.back();
  const auto i = static_cast<std::size_t>(after);
  const double weight = (at - t[i - 1]) / (t[i] - t[i - 1]);
  return channel[i - 1] + weight * (channel[i] - channel[i - 1]);
}

}  // namespace gyrostat
