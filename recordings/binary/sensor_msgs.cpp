#include <gyrostat/recordings/binary/sensor_msgs.hpp>

#include <algorithm>

#include <gyrostat/recordings/binary/cursor.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t orientation_and_its_covariance = 4 + 9, covariance = 9;

/// The body of the message, of which `next()` gives the doubles in turn.
template <class Next>
void take_body(ImuSample& sample, const Next& next) {
  for (std::size_t i = 0; i < orientation_and_its_covariance; ++i) next();
  for (double& rate : sample.gyro_rad_s) rate = next();
  for (std::size_t i = 0; i < covariance; ++i) next();
  for (double& acceleration : sample.acc_mps2) acceleration = next();
  // A covariance that begins with -1 says that there is no such measurement.
  if (next() == -1.0) sample.acc_mps2.fill(no_value);
}

std::int64_t nanoseconds(std::int64_t s, std::int64_t ns, std::int64_t logged_ns) {
  return s == 0 && ns == 0 ? logged_ns : s * 1'000'000'000 + ns;
}

}  // namespace

bool is_imu_type(std::string_view type) {
  return type == "sensor_msgs/Imu" || type == "sensor_msgs/msg/Imu";
}

ImuSample imu_of_ros1(std::string_view message, std::int64_t logged_ns) {
  Cursor at(message);
  ImuSample sample;
  at.number<std::uint32_t>();  // sequence
  const auto s = at.number<std::uint32_t>(), ns = at.number<std::uint32_t>();
  sample.t_ns = nanoseconds(s, ns, logged_ns);
  at.text();  // frame
  take_body(sample, [&] { return at.number<double>(); });
  return sample;
}

ImuSample imu_of_cdr(std::string_view message, std::int64_t logged_ns) {
  Cursor at(message);
  const auto head = at.bytes(4);
  const bool big = (head[1] & 1) == 0;
  std::size_t position = 0;  // numbers stand at multiples of their size behind the head
  const auto next = [&]<class T>(T) {
    const auto padding = (sizeof(T) - position % sizeof(T)) % sizeof(T);
    at.bytes(padding);
    auto bytes = std::string(at.bytes(sizeof(T)));
    if (big) std::reverse(bytes.begin(), bytes.end());
    position += padding + sizeof(T);
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  };
  ImuSample sample;
  const auto s = next(std::int32_t{});
  const auto ns = next(std::uint32_t{});
  sample.t_ns = nanoseconds(s, ns, logged_ns);
  const auto frame = next(std::uint32_t{});
  at.bytes(frame);
  position += frame;
  take_body(sample, [&] { return next(double{}); });
  return sample;
}

}  // namespace gyrostat
