#include <gyrostat/experiments/pages/matching.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {

Target target_match() {
  return {.file = "match.json",
          .seeds = {R"({"title": "m", "study": "study.json", "trials": 3, "evaluations": 9,
             "rounds": 1, "search": "covariance", "loss": "met",
             "free": [{"path": "scenario.random_error.phi", "low": 0.1, "high": 0.9, "start": 0.3,
                       "cells": ["a"]}, {"path": "scenario.rate_hz", "low": 5, "high": 20,
                       "whole": 1}],
             "targets": [{"cell": "a", "method": "kf", "metric": "bias_rmse", "value": 0.01,
                          "tolerance": 0.001}]})"},
          .read = [](const std::filesystem::path& path) { read_match(path.string()); },
          .beside = {{"study.json", R"({"cells": [{"name": "a", "filters": ["kf"],
                       "scenario": {"duration_s": 5, "rate_hz": 10}}]})"}}};
}

}  // namespace gyrostat::fuzz
