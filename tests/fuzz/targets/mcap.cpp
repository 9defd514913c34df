#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::fuzz {

Target target_mcap() {
  return {.file = "drive.mcap",
          .seeds = {mcap_bytes(""), mcap_bytes("lz4"), mcap_bytes("zstd")},
          .read = [](const std::filesystem::path& path) { read_z(path, "mcap"); }};
}

}  // namespace gyrostat::fuzz
