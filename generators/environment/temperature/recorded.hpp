#pragma once

#include <gyrostat/core/fields.hpp>
#include <gyrostat/generators/environment/recorded.hpp>

namespace gyrostat::temperature {

/// The temperature of a recording.
struct Recorded {
  std::shared_ptr<const Series> recording;

  static constexpr std::string_view title = "the temperature of the scenario's recording";

  static constexpr auto fields() { return std::array<Field<Recorded, double>, 0>{}; }

  double operator()(double t_s) const {
    return recorded_at(*recording, recording->temperature_C, t_s);
  }
};

}  // namespace gyrostat::temperature
