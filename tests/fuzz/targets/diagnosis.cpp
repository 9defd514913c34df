#include <gyrostat/experiments/findings/models/model_format.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {
namespace {

/// What a diagnosis is read for: models for other programs.
void read_diagnosis(const std::filesystem::path& path) {
  const auto model = read_model(path.string(), "");
  for (const auto& format : model_formats()) {
    write_model(model, format, {.averaging_s = 0.5, .inflate = true});
    left_open(model, {"outliers"});
  }
}

}  // namespace

Target target_diagnosis() {
  return {.file = "gap.json",
          .seeds = {R"({"verdict": "outliers", "enriched": {"duration_s": 60, "rate_hz": 20,
               "random_error": {"phi": 0.5, "delta1_dps": 1e-4, "delta2_dps": 1e-4},
               "thermal_drift": {"a_dps_per_C": 0.002, "c_dps": 0.1},
               "effects": [{"effect": "outliers", "std_dps": 0.1},
                           {"effect": "bias_instability", "coefficient_dps": 0.01}]},
             "gap": {"before": 10.5}, "steps": [{"added": "", "gap": 10.5},
                                                {"added": "outliers", "gap": 1.5}],
             "effects": [{"effect": "outliers", "gap_without": 9}]})"},
          .read = read_diagnosis};
}

}  // namespace gyrostat::fuzz
