#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/recordings/text.hpp>
#include <gyrostat/recordings/write_columns.hpp>

namespace {

namespace fs = std::filesystem;

/// Half an hour at 100 Hz of time, gyro, temperature and heading, in a file of its own.
struct RecordingFile {
  fs::path path;

  explicit RecordingFile(const std::string& extension)
      : path(fs::temp_directory_path() /
             ("gyrostat_recording_bench_" + std::to_string(getpid()) + extension)) {
    gyrostat::write_series(path, series());
  }
  ~RecordingFile() { fs::remove(path); }

  static gyrostat::Series series() {
    gyrostat::Series series;
    for (int i = 0; i < 180'000; ++i) {
      series.t_s.push_back(0.01 * i);
      series.gyro_dps.push_back(std::sin(0.37 * i));
      series.temperature_C.push_back(25 + 0.001 * std::fmod(0.1 * i, 977.0));
      series.heading_deg.push_back(90 * std::cos(0.11 * i));
    }
    return series;
  }
};

void count_text(benchmark::State& state, const fs::path& path) {
  const auto bytes = gyrostat::read_text(path).size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}

void read_recording(benchmark::State& state, const std::string& extension) {
  const RecordingFile file(extension);
  for (auto _ : state) benchmark::DoNotOptimize(gyrostat::read_recording(file.path));
  count_text(state, file.path);
}

void write_series(benchmark::State& state, const std::string& extension) {
  const RecordingFile file(extension);
  const auto series = RecordingFile::series();
  for (auto _ : state) gyrostat::write_series(file.path, series);
  count_text(state, file.path);
}

BENCHMARK_CAPTURE(read_recording, plain, ".csv")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_recording, gz, ".csv.gz")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_series, plain, ".csv")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_series, gz, ".csv.gz")->Unit(benchmark::kMillisecond);

}  // namespace
