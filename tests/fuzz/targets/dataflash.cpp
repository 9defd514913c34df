#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::fuzz {

Target target_dataflash() {
  return {.file = "log.bin",
          .seeds = {dataflash_bytes()},
          .read = [](const std::filesystem::path& path) { read_z(path, "dataflash"); }};
}

}  // namespace gyrostat::fuzz
