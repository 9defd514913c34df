#pragma once

#include <algorithm>
#include <memory>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/series.hpp>

namespace gyrostat::temperature {

/// The temperature of a recording, linear between its samples, held before and after.
struct Recorded {
  std::shared_ptr<const Series> recording;

  static constexpr std::string_view title = "the temperature of the scenario's recording";

  static constexpr auto fields() { return std::array<Field<Recorded, double>, 0>{}; }

  double operator()(double t_s) const {
    const auto& t = recording->t_s;
    const auto& temperature = recording->temperature_C;
    const double at = t.front() + t_s;
    const auto after = std::upper_bound(t.begin(), t.end(), at) - t.begin();
    if (after == 0) return temperature.front();
    if (after == std::ssize(t)) return temperature.back();
    const auto i = static_cast<std::size_t>(after);
    const double weight = (at - t[i - 1]) / (t[i] - t[i - 1]);
    return temperature[i - 1] + weight * (temperature[i] - temperature[i - 1]);
  }
};

}  // namespace gyrostat::temperature
