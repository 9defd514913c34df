#include <gyrostat/experiments/coverage/coverage.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {

Target target_coverage() {
  return {.file = "coverage.json",
          .seeds = {project_file("experiments/studies/coverage.json")},
          .read = [](const std::filesystem::path& path) { read_coverage(path.string()); }};
}

}  // namespace gyrostat::fuzz
