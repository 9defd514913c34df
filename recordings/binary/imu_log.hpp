#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/column_table.hpp>

namespace gyrostat {

/// One message of an inertial measurement unit, as logs have it.
struct ImuSample {
  std::int64_t t_ns = 0;
  std::array<double, 3> gyro_rad_s{no_value, no_value, no_value};
  std::array<double, 3> acc_mps2{no_value, no_value, no_value};
  double temperature_C = no_value;
};

/// The messages of a log's gyros, by topic.
class ImuLog {
 public:
  /// A sample that does not come after the one before it in its topic is left out and counted.
  void add(std::string_view topic, const ImuSample& sample);
  /// The log ends within a record.
  void cut_off() { cut_off_ = true; }
  /// The topic that is wanted, or, where none is, that with the most samples. Time begins with its
  /// first. Throws InputError at `place` where there is no such topic, or none at all; `searched`
  /// says what a gyro would be.
  ColumnTable table(const std::string& wanted, const std::string& place,
                    std::string_view searched) &&;

 private:
  struct Topic {
    std::vector<std::int64_t> t_ns;
    std::array<std::vector<double>, 7> values;  ///< gyro, acceleration, temperature
    std::size_t left_out = 0;
  };
  std::map<std::string, Topic, std::less<>> topics_;
  bool cut_off_ = false;
};

}  // namespace gyrostat
