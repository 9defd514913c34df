#pragma once

#include <gyrostat/core/fields.hpp>

namespace gyrostat {

/// Linear thermal drift of a gyro's bias [B eq. 2]: B_f = a T + b T' + c.
template <class T>
struct ThermalDrift {
  T a_dps_per_C{0.0};
  T b_dps_s_per_C{0.0};
  T c_dps{0.0};

  static constexpr auto fields() {
    using P = ThermalDrift;
    return std::array{
        Field{"a_dps_per_C", &P::a_dps_per_C, "dps/°C", ranges::any, "bias per temperature, a"},
        Field{"b_dps_s_per_C", &P::b_dps_s_per_C, "dps·s/°C", ranges::any,
              "bias per rate of temperature, b"},
        Field{"c_dps", &P::c_dps, "dps", ranges::any, "constant bias, c"},
    };
  }
};

}  // namespace gyrostat
