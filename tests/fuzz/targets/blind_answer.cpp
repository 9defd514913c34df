#include <gyrostat/experiments/blind/blind_answer.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {

Target target_blind_answer() {
  return {.file = "answer.json",
          .seeds = {R"({"verdict": "outliers", "verdict_set": ["outliers", "unknown"],
             "effects": [{"effect": "outliers", "inclusion": 0.9},
                         {"effect": "quantization", "inclusion": 0.2}],
             "gap": {"closed": 0.7, "closed_interval": [0.5, 0.9]}})",
                    R"({"verdict": "none"})"},
          .read = [](const std::filesystem::path& path) { gap::read_answer(path); }};
}

}  // namespace gyrostat::fuzz
