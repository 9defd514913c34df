#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::fuzz {
namespace {

std::string packed(std::string_view text) {
  std::string bytes;
  Gzip gzip([&](std::string_view piece) { bytes += piece; });
  gzip.write(text);
  gzip.finish();
  return bytes;
}

}  // namespace

Target target_gzip() {
  const std::string text = "t_s,gyro_z_dps\n0,1\n1,2\n2,3\n3,4\n";
  return {.file = "rec.gz",
          .seeds = {packed(text), packed("t_s,gyro_z_dps\n0,1\n") + packed("1,2\n2,3\n"),
                    packed(ulog_bytes())},
          .read = [](const std::filesystem::path& path) { read_z(path); }};
}

}  // namespace gyrostat::fuzz
