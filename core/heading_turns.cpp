#include <gyrostat/core/heading_turns.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

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

double TurnsTogether::correlation() const {
  return products / std::sqrt(heading_squares * rate_squares);
}

TurnsTogether turns_together(const Series& recording, const std::vector<double>& turned_deg,
                             const std::vector<double>& rate_dps) {
  TurnsTogether together;
  if (recording.size() < 2) return together;
  const auto second = static_cast<std::size_t>(std::max(1.0, std::round(recording.rate_hz())));
  double held_deg = no_value, before_deg = no_value, sum_deg = 0.0;
  for (std::size_t i = 0; i < turned_deg.size(); ++i) {
    if (!is_missing(turned_deg[i])) held_deg = turned_deg[i];
    if (i % second == 0) {
      const double change_deg = held_deg - before_deg;
      if (!is_missing(change_deg) && !is_missing(sum_deg)) {
        together.count += 1.0;
        together.heading_squares += change_deg * change_deg;
        together.rate_squares += sum_deg * sum_deg;
        together.products += change_deg * sum_deg;
      }
      before_deg = held_deg;
      sum_deg = 0.0;
    }
    if (i + 1 < turned_deg.size())
      sum_deg += rate_dps[i] * (recording.t_s[i + 1] - recording.t_s[i]);
  }
  return together;
}

}  // namespace gyrostat
