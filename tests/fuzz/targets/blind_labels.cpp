#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {

Target target_blind_labels() {
  return {.file = "sealed_labels.json",
          .seeds = {R"([{"recording": 0, "effects": ["outliers"], "strength": "strong",
             "duration_s": 60, "rate_hz": 20, "scenario": "still", "form": "", "noise": "",
             "own": ["quantization"], "without": [], "left_out": "outliers"}])"},
          .read = [](const std::filesystem::path& path) { gap::open_labels(path.parent_path()); }};
}

}  // namespace gyrostat::fuzz
