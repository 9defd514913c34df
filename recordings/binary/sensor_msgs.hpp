#pragma once

#include <string_view>

#include <gyrostat/recordings/binary/imu_log.hpp>

namespace gyrostat {

/// Whether a message type is sensor_msgs/Imu, as ROS 1 or ROS 2 (sensor_msgs/msg/Imu) writes it.
bool is_imu_type(std::string_view type);

/// sensor_msgs/Imu as ROS 1 serialises it, or, in CDR (OMG DDSI-RTPS 10.5), as ROS 2 does. The time
/// is that of its header, or `logged_ns` where that is zero. Throws CutOff.
ImuSample imu_of_ros1(std::string_view message, std::int64_t logged_ns);
ImuSample imu_of_cdr(std::string_view message, std::int64_t logged_ns);

}  // namespace gyrostat
