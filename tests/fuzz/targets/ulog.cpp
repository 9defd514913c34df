#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::fuzz {

Target target_ulog() {
  return {.file = "log.ulg",
          .seeds = {ulog_bytes(), fifo_ulog_bytes()},
          .read = [](const std::filesystem::path& path) { read_z(path, "ulog"); }};
}

}  // namespace gyrostat::fuzz
