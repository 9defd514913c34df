#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/program.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::fuzz {
namespace {

std::string seed_of_rosbag2() {
  const TestFolder folder;
  write_rosbag2((folder.path() / "bag.db3").string());
  return folder.read("bag.db3");
}

}  // namespace

Target target_rosbag2() {
  return {.file = "bag.db3",
          .seeds = {seed_of_rosbag2()},
          .read = [](const std::filesystem::path& path) { read_z(path, "rosbag2"); }};
}

}  // namespace gyrostat::fuzz
