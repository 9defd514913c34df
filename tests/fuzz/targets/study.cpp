#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {
namespace {

/// Every key of a study that others do not have.
constexpr auto all_keys = R"({
  "title": "t", "seed": 7, "failure_budget": 0.5,
  "cells": [{
    "name": "a", "trials": 20, "parameters_from": "truth", "assumed": {"phi": 1.5}, "denoise": 1,
    "scenario": {
      "duration_s": 10, "rate_hz": 20, "random_error": {"phi": 0.5, "delta1_dps": 1e-4},
      "thermal_drift": {"a_dps_per_C": 0.002}, "temperature": {"profile": "cycle"},
      "motion": {"profile": "sinusoidal", "amplitude_dps": 3},
      "compass": {"noise_std_deg": 0.05, "disturbances": [{"start_s": 2, "duration_s": 3}]},
      "effects": [{"effect": "outliers", "std_dps": 0.1}]},
    "calibration": {"fit": "moments", "each_trial": 1, "duration_s": 20},
    "tuning": {"metric": "nis", "trials": 5, "evaluations": 9},
    "filters": ["none", {"id": "k", "filter": "kf", "parameters": {"phi": 0.4},
                         "tune": {"measurement_noise_std_dps": [0.001, 1]}}],
    "design": {"kind": "sobol", "points": 4, "parameters": {
      "scenario.random_error.phi": {"from": 0.1, "to": 0.9},
      "scenario.effects.0.std_dps": {"from": 0.01, "to": 1, "scale": "log"}}}
  }]})";

constexpr auto designs = R"({"cells": [
  {"name": "g", "scenario": {"duration_s": 20, "rate_hz": 10}, "filters": ["kf"],
   "failure": {"metric": "bias_rmse", "above": 1},
   "grid": {"scenario.rate_hz": [10, 20], "filters.kf.parameters.phi": [0.1, 0.2]}},
  {"name": "m", "scenario": {"duration_s": 20, "rate_hz": 10}, "filters": ["kf", "stf"],
   "design": {"kind": "morris", "trajectories": 3, "levels": 4,
              "parameters": {"scenario.rate_hz": {"from": 5, "to": 20}}}},
  {"name": "l", "scenario": {"duration_s": 20, "rate_hz": 10}, "filters": ["oracle"],
   "design": {"kind": "list", "points": [{"trials": 3}, {"scenario.rate_hz": 7}]}}]})";

}  // namespace

Target target_study() {
  return {.file = "study.json",
          .seeds = {all_keys, designs, project_file("experiments/studies/main_job.json"),
                    project_file("experiments/studies/motion.json"),
                    project_file("experiments/studies/rare_failure.json"),
                    project_file("experiments/studies/table_one_walk.json")},
          .read = [](const std::filesystem::path& path) { read_study(path.string()); }};
}

}  // namespace gyrostat::fuzz
