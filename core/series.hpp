#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// A sampled gyro signal and what was recorded beside it. A channel that is absent is empty; a
/// sample that is missing is NaN. The last channels are the simulator's truth.
///
/// Example: a minute at 100 Hz, and its second half.
///
///   Series series;
///   for (int k = 0; k < 6000; ++k) {
///     series.t_s.push_back(0.01 * k);
///     series.gyro_dps.push_back(k % 2 ? 0.1 : -0.1);
///   }
///   const Series half = series.slice(3000, 3000);
///
/// Thread safety: that of its vectors. Any number of threads may read one; one that is changed
/// belongs to a single thread.
struct Series {
  std::vector<double> t_s;
  std::vector<double> gyro_dps;
  std::vector<double> temperature_C;
  std::vector<double> heading_deg;  ///< compass, wrapped to +-180
  std::vector<double> mag_valid;    ///< 1 where the compass may be used, 0 where it is disturbed
  std::vector<double> rate_ref_dps;
  std::vector<double> acc_x_mps2, acc_y_mps2, acc_z_mps2;
  /// Rates about the two other axes, in the order x, y, z, x: of a gyro about y those about z and
  /// x.
  std::vector<double> cross_rate_1_dps, cross_rate_2_dps;
  std::vector<double> thermal_bias_dps;  ///< truth: drift driven by temperature, B_f
  std::vector<double> random_error_dps;  ///< truth: correlated random error, x

  std::size_t size() const { return t_s.size(); }
  /// Mean sampling rate; 0 for fewer than two samples.
  double rate_hz() const;
  double duration_s() const { return t_s.empty() ? 0.0 : t_s.back() - t_s.front(); }
  /// Samples [first, first + count) of every channel present.
  Series slice(std::size_t first, std::size_t count) const;
  /// Empties every channel and keeps its memory.
  void clear();
};

/// The samples from `from_s` until before `to_s`, counted from the first; throws InputError at
/// `place` where there are none.
Series cut(const Series& series, double from_s, double to_s, std::string_view place);

struct Channel {
  std::string_view name;
  std::vector<double> Series::*values;
  std::string_view unit;
};

/// Every channel, under the column name that recordings use.
inline constexpr std::array channels = {
    Channel{"t_s", &Series::t_s, "s"},
    Channel{"gyro_dps", &Series::gyro_dps, "dps"},
    Channel{"temperature_C", &Series::temperature_C, "°C"},
    Channel{"heading_deg", &Series::heading_deg, "deg"},
    Channel{"mag_valid", &Series::mag_valid, "1"},
    Channel{"rate_ref_dps", &Series::rate_ref_dps, "dps"},
    Channel{"acc_x_mps2", &Series::acc_x_mps2, "m/s²"},
    Channel{"acc_y_mps2", &Series::acc_y_mps2, "m/s²"},
    Channel{"acc_z_mps2", &Series::acc_z_mps2, "m/s²"},
    Channel{"cross_rate_1_dps", &Series::cross_rate_1_dps, "dps"},
    Channel{"cross_rate_2_dps", &Series::cross_rate_2_dps, "dps"},
    Channel{"thermal_bias_dps", &Series::thermal_bias_dps, "dps"},
    Channel{"random_error_dps", &Series::random_error_dps, "dps"},
};

}  // namespace gyrostat
