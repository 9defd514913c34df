#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::ardupilot_csv {
namespace {

RecordingLayout layout(const FormatHead& head) {
  RecordingLayout layout;
  layout.columns = {{"t", "TimeUS"}, {"gyro_x", "GyrX"}, {"gyro_y", "GyrY"}, {"gyro_z", "GyrZ"}};
  layout.units = {{"t", "us"}, {"gyro_x", "rad/s"}, {"gyro_y", "rad/s"}, {"gyro_z", "rad/s"}};
  for (const std::string axis : {"X", "Y", "Z"})
    if (head.has("Acc" + axis)) {
      const std::string channel = "acc_" + std::string(1, static_cast<char>(axis[0] - 'X' + 'x'));
      layout.columns[channel] = "Acc" + axis;
      layout.units[channel] = "m/s2";
    }
  if (head.has("T")) {
    layout.columns["temp"] = "T";
    layout.units["temp"] = "C";
  }
  return layout;
}

}  // namespace

/// IMU messages of an ArduPilot log as CSV (mavlogdump.py --format csv --types IMU): microseconds,
/// rad/s, m/s² and °C (ArduPilot, LogStructure.h).
RecordingFormat format() {
  return {.title = "CSV of ArduPilot's IMU messages (mavlogdump)",
          .recognises =
              [](const FormatHead& head) {
                return head.has_all({"TimeUS", "GyrX", "GyrY", "GyrZ"});
              },
          .layout = layout};
}

}  // namespace gyrostat::formats::ardupilot_csv
