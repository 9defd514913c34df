#include <gyrostat/experiments/pages/ledger.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {

Target target_ledger() {
  return {.file = "claims.json",
          .seeds = {R"({"title": "l", "claims": [
             {"claim": "c", "source": "[A]", "study": "study.json", "method": "kf", "than": "none",
              "metric": "bias_rmse", "cells": ["a"], "exponential_per_dps2": 10, "absolute": 1},
             {"claim": "d", "of": "D", "study": "study.json", "method": "kf", "value": 1,
              "allan_tau_s": [0.1, 1], "allan_trials": 5, "above": 1},
             {"claim": "e", "not_judged": "no sensor"}]})"},
          .read = [](const std::filesystem::path& path) { read_ledger(path.string()); },
          .beside = {{"study.json", R"({"cells": [{"name": "a", "filters": ["none", "kf"],
                       "scenario": {"duration_s": 5, "rate_hz": 10}}]})"}}};
}

}  // namespace gyrostat::fuzz
