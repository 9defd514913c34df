#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat::formats::rostopic {
namespace {

RecordingLayout layout(const FormatHead& head) {
  RecordingLayout layout;
  const bool stamped = head.has("field.header.stamp");
  layout.columns = {{"t", stamped ? "field.header.stamp" : "time"},
                    {"gyro_x", "field.angular_velocity.x"},
                    {"gyro_y", "field.angular_velocity.y"},
                    {"gyro_z", "field.angular_velocity.z"}};
  layout.units = {{"t", "ns"}, {"gyro_x", "rad/s"}, {"gyro_y", "rad/s"}, {"gyro_z", "rad/s"}};
  if (head.has("field.linear_acceleration.x"))
    for (const char axis : {'x', 'y', 'z'}) {
      layout.columns[std::string("acc_") + axis] = std::string("field.linear_acceleration.") + axis;
      layout.units[std::string("acc_") + axis] = "m/s2";
    }
  return layout;
}

}  // namespace

/// What `rostopic echo -b BAG -p TOPIC` prints of sensor_msgs/Imu: `%time,field.header.seq,…`,
/// times in nanoseconds (ROS wiki, rostopic).
RecordingFormat format() {
  return {.title = "rostopic echo -p of sensor_msgs/Imu (ROS 1)",
          .recognises =
              [](const FormatHead& head) {
                return (head.has("%time") || head.has("time") || head.has("field.header.stamp")) &&
                       head.has_all({"field.angular_velocity.x", "field.angular_velocity.y",
                                     "field.angular_velocity.z"});
              },
          .layout = layout};
}

}  // namespace gyrostat::formats::rostopic
