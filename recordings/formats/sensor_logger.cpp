#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::sensor_logger {
namespace {

RecordingLayout layout(const FormatHead&) {
  RecordingLayout layout;
  layout.columns = {{"t", "seconds_elapsed"}, {"gyro_x", "x"}, {"gyro_y", "y"}, {"gyro_z", "z"}};
  layout.units = {{"t", "s"}, {"gyro_x", "rad/s"}, {"gyro_y", "rad/s"}, {"gyro_z", "rad/s"}};
  return layout;
}

bool has_columns(const FormatHead& head) {
  return head.has_all({"time", "seconds_elapsed", "z", "y", "x"});
}

/// Every sensor of the app has this header, so the name of the file says which one it is.
bool recognises(const FormatHead& head) {
  const auto name = head.path.filename().string();
  if (!has_columns(head)) return false;
  if (name.starts_with("Gyroscope")) return true;
  throw InputError(
      head.path.string(),
      "is of Sensor Logger, whose sensors all have the columns time, seconds_elapsed, "
      "z, y, x; name its Gyroscope.csv, or say --preset sensor_logger where it is that");
}

}  // namespace

/// `Gyroscope.csv` or `GyroscopeUncalibrated.csv` of the app Sensor Logger: nanoseconds since 1970,
/// seconds since the start, then rad/s about z, y and x, none of which the header says
/// (github.com/tszheichoi/awesome-sensor-logger).
RecordingFormat format() {
  return {.title = "Sensor Logger: Gyroscope.csv, in rad/s",
          .recognises = recognises,
          .layout = layout};
}

}  // namespace gyrostat::formats::sensor_logger
