#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::fuzz {

Target target_rosbag() {
  return {.file = "drive.bag",
          .seeds = {bag_bytes("none"), bag_bytes("bz2"), bag_bytes("lz4")},
          .read = [](const std::filesystem::path& path) { read_z(path, "rosbag"); }};
}

}  // namespace gyrostat::fuzz
