#include <gyrostat/experiments/findings/application.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {

Target target_config() {
  return {
      .file = "config.json",
      .seeds = {R"({"filters": [{"id": "my_kf", "filter": "kf", "parameters": {"phi": 0.3}},
                                    {"filter": "sr_rsukf", "parameters": {"mu_phi": 0.02}},
                                    "oracle"]})"},
      .read = [](const std::filesystem::path& path) { read_application_config(path.string()); }};
}

}  // namespace gyrostat::fuzz
