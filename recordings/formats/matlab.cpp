#include <algorithm>
#include <array>

#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/matlab.hpp>

namespace gyrostat::formats::matlab {
namespace {

bool has(const ColumnTable& table, const std::string& name) {
  return std::ranges::find(table.names, name) != table.names.end();
}

/// Matrices as MATLAB's imuSensor and its examples call them, in rad/s and m/s².
void name_matrices(ColumnTable& table) {
  for (const std::string matrix :
       {"gyroReadings", "gyroData", "AngularVelocity", "angularVelocity"})
    for (std::size_t k = 0; k < 3 && !has(table, "gyro_dps") && has(table, matrix + "(:,3)"); ++k) {
      const std::string channel = std::string("gyro_") + "xyz"[k];
      table.layout.columns[channel] = matrix + "(:," + std::to_string(k + 1) + ")";
      table.layout.units[channel] = "rad/s";
    }
  for (const std::string matrix :
       {"accelReadings", "accelData", "Acceleration", "LinearAcceleration"})
    for (std::size_t k = 0; k < 3 && has(table, matrix + "(:,3)"); ++k) {
      const std::string channel = std::string("acc_") + "xyz"[k];
      table.layout.columns[channel] = matrix + "(:," + std::to_string(k + 1) + ")";
      table.layout.units[channel] = "m/s2";
    }
}

ColumnTable read(const FormatSource& source) {
  ColumnTable table = read_mat(source.path);
  name_matrices(table);
  for (const std::string rate : {"Fs", "fs", "SampleRate", "samplingRate"}) {
    const auto found = std::ranges::find(table.names, rate);
    if (found == table.names.end() || has(table, "t_s")) continue;
    const auto& value = table.values[static_cast<std::size_t>(found - table.names.begin())];
    if (value.size() == 1 && value.front() > 0.0) table.layout.rate_hz = value.front();
  }
  return table;
}

}  // namespace

/// MATLAB's files of versions 5 and 7.3: vectors, columns of matrices, fields of structs, and the
/// rate `Fs` where there are no times. Readings under the names that imuSensor's examples use are
/// in its units, rad/s and m/s².
RecordingFormat format() {
  return {.title = "MATLAB (.mat): vectors, matrices and structs, with Fs",
          .recognises = [](const FormatHead& head) { return is_mat_file(head.path); },
          .read = read};
}

}  // namespace gyrostat::formats::matlab
