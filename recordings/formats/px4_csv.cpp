#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::px4_csv {
namespace {

bool is_combined(const FormatHead& head) {
  return head.has_all({"timestamp", "gyro_rad[0]", "gyro_rad[1]", "gyro_rad[2]"});
}

bool is_sensor_gyro(const FormatHead& head) {
  return head.has_all({"timestamp", "device_id", "x", "y", "z"}) &&
         head.path.filename().string().find("sensor_gyro") != std::string::npos;
}

RecordingLayout layout(const FormatHead& head) {
  RecordingLayout layout;
  layout.columns = {{"t", "timestamp"}};
  layout.units = {{"t", "us"}};
  const bool combined = !is_sensor_gyro(head);
  for (const int k : {0, 1, 2}) {
    const std::string axis(1, static_cast<char>('x' + k)), index = "[" + std::to_string(k) + "]";
    layout.columns["gyro_" + axis] = combined ? "gyro_rad" + index : axis;
    layout.units["gyro_" + axis] = "rad/s";
    if (!head.has("accelerometer_m_s2" + index)) continue;
    layout.columns["acc_" + axis] = "accelerometer_m_s2" + index;
    layout.units["acc_" + axis] = "m/s2";
  }
  if (!combined && head.has("temperature")) {
    layout.columns["temp"] = "temperature";
    layout.units["temp"] = "C";
  }
  return layout;
}

}  // namespace

/// `LOG_sensor_combined_0.csv` or `LOG_sensor_gyro_0.csv`, as ulog2csv makes them of a PX4 flight
/// log: timestamps in microseconds, rates in rad/s (docs.px4.io, uORB messages).
RecordingFormat format() {
  return {.title = "ulog2csv (PX4): sensor_combined or sensor_gyro",
          .recognises =
              [](const FormatHead& head) { return is_combined(head) || is_sensor_gyro(head); },
          .layout = layout};
}

}  // namespace gyrostat::formats::px4_csv
