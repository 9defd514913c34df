#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/generators/environment/recorded.hpp>

namespace gyrostat::acceleration {

/// The specific force of a recording.
struct Recorded {
  std::shared_ptr<const Series> recording;

  static constexpr std::string_view title = "the acceleration of the scenario's recording";

  static constexpr auto fields() { return std::array<Field<Recorded, double>, 0>{}; }

  std::array<double, 3> operator()(double t_s) const {
    return {recorded_at(*recording, recording->acc_x_mps2, t_s),
            recorded_at(*recording, recording->acc_y_mps2, t_s),
            recorded_at(*recording, recording->acc_z_mps2, t_s)};
  }
};

}  // namespace gyrostat::acceleration
