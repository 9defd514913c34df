#pragma once

#include <gyrostat/core/fields.hpp>
#include <gyrostat/generators/environment/recorded.hpp>

namespace gyrostat::motion {

/// A true rate of a recording.
struct Recorded {
  std::shared_ptr<const Series> recording;
  std::vector<double> Series::*rate_dps = &Series::rate_ref_dps;

  static constexpr std::string_view title = "the rate of the scenario's recording";

  static constexpr auto fields() { return std::array<Field<Recorded, double>, 0>{}; }

  double operator()(double t_s) const {
    return recorded_at(*recording, (*recording).*rate_dps, t_s);
  }
};

}  // namespace gyrostat::motion
