#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::euroc {
namespace {

RecordingLayout layout(const FormatHead&) {
  RecordingLayout layout;
  layout.columns = {{"t", "timestamp [ns]"},           {"gyro_x", "w_RS_S_x [rad s^-1]"},
                    {"gyro_y", "w_RS_S_y [rad s^-1]"}, {"gyro_z", "w_RS_S_z [rad s^-1]"},
                    {"acc_x", "a_RS_S_x [m s^-2]"},    {"acc_y", "a_RS_S_y [m s^-2]"},
                    {"acc_z", "a_RS_S_z [m s^-2]"}};
  return layout;
}

}  // namespace

/// `mav0/imu0/data.csv` of the EuRoC MAV data sets, and of the many that write as they do (TUM VI,
/// ILLIXR, …). Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 2016.
RecordingFormat format() {
  return {.title = "EuRoC MAV or TUM VI: imu0/data.csv",
          .recognises =
              [](const FormatHead& head) {
                return head.has_all({"timestamp [ns]", "w_RS_S_x [rad s^-1]", "w_RS_S_y [rad s^-1]",
                                     "w_RS_S_z [rad s^-1]", "a_RS_S_x [m s^-2]",
                                     "a_RS_S_y [m s^-2]", "a_RS_S_z [m s^-2]"});
              },
          .layout = layout};
}

}  // namespace gyrostat::formats::euroc
