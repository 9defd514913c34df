#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/recordings/log_bytes.hpp>

namespace gyrostat::fuzz {
namespace {

void read_numpy(const std::filesystem::path& path) {
  RecordingLayout layout;
  layout.columns = {{"t", "1"}, {"gyro", "4"}};
  layout.units = {{"gyro", "rad/s"}};
  layout.preset = "numpy";
  auto recording = read_recording(path, "", layout);
  make_even(recording, path.string(), layout);
}

}  // namespace

Target target_numpy() {
  return {
      .file = "a.npy", .seeds = {npy_bytes(), record_npy_bytes(), npz_bytes()}, .read = read_numpy};
}

}  // namespace gyrostat::fuzz
