#include <gyrostat/experiments/blind/blind_check.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {
namespace {

constexpr auto small_check = R"({
 "seed": 3, "recordings": 2, "none_recordings": 1, "durations_s": [60, 120],
 "scenarios": {"still": {"rate_hz": 20}},
 "cases": [{"effect": "outliers", "scenario": "still", "strong": {}, "weak": {"std_dps": 0.1}}]
})";

}  // namespace

Target target_blind_check() {
  return {.file = "check.json",
          .seeds = {small_check, project_file("experiments/studies/blind_check.json"),
                    project_file("experiments/studies/blind_check_sets.json")},
          .read = [](const std::filesystem::path& path) { gap::read_blind_check(path.string()); }};
}

}  // namespace gyrostat::fuzz
