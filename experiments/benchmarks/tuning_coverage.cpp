// tuning_coverage [tunings] [further trials] [seed]: how often a tuned method keeps on further
// trials what was claimed of it, as tables.json of a page, and as Markdown on standard error.
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <nlohmann/json.hpp>

#include <gyrostat/analysis/error_metric.hpp>
#include <gyrostat/analysis/statistics/proportion.hpp>
#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/experiments/run/method_tuning.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat {
namespace {

constexpr const char* studied = R"({"cells": [
  {"name": "still", "scenario": {"duration_s": 10, "rate_hz": 50},
   "filters": [{"filter": "kf", "tune": {"phi": [-0.9, 0.9], "delta1_dps": [1e-4, 0.02],
                                         "measurement_noise_std_dps": [0.005, 0.5]}},
               {"filter": "stf", "tune": {"softening": [1, 100], "forgetting": [0.5, 1]}}]},
  {"name": "outliers", "scenario": {"duration_s": 10, "rate_hz": 50,
      "effects": [{"effect": "outliers", "probability": 0.002, "std_dps": 2}]},
   "filters": [{"filter": "kf", "tune": {"phi": [-0.9, 0.9], "delta1_dps": [1e-4, 0.02],
                                         "measurement_noise_std_dps": [0.005, 0.5]}},
               {"filter": "stf", "tune": {"softening": [1, 100], "forgetting": [0.5, 1]}}]}]})";

/// Claims of one kind, and what became of them.
struct Claims {
  double claims = 0.0, held = 0.0, better = 0.0;

  void add(const MethodTuning& tuned, const TrialMeasure::Value& truth) {
    ++claims;
    held += tuned.after.low <= truth.value && truth.value <= tuned.after.high;
    better += tuned.is_better();
  }
  void add(const Claims& others) {
    claims += others.claims;
    held += others.held;
    better += others.better;
  }
  std::vector<TableCell> row(const std::string& cell, const std::string& method,
                             const std::string& measure) const {
    const auto [low, high] = wilson_interval(held, claims, 0.95);
    return {cell,
            method,
            measure,
            static_cast<std::int64_t>(claims),
            100.0 * held / claims,
            100.0 * low,
            100.0 * high,
            100.0 * std::sqrt(0.05 * 0.95 / claims),
            100.0 * better / claims};
  }
};

std::vector<NamedTable> tuning_coverage(std::uint32_t tunings, std::uint32_t further,
                                        std::uint64_t seed) {
  Table table{.title = "Claims of tuning that hold on further trials, nominally 95 %",
              .columns = {{"cell", ""},
                          {"method", ""},
                          {"measure", ""},
                          {"tunings", ""},
                          {"held", "%"},
                          {"from", "%"},
                          {"to", "%"},
                          {"standard error", "%"},
                          {"told as better", "%"}}};
  const auto study = parse_study(Json::parse(studied), "tuning_coverage");
  using Kind = TrialMeasure::Kind;
  const auto metric = error_metric_named("bias_rmse", "tuning_coverage");
  Claims all;
  for (const auto& cell : study.cells)
    for (std::size_t m = 0; m < cell.methods.size(); ++m)
      for (const auto kind : {Kind::mean, Kind::cvar95, Kind::probability}) {
        Claims claims;
        for (std::uint32_t i = 0; i < tunings; ++i, ++seed) {  // no two claims share a trial
          TuningGoal goal{
              .metric = metric, .measure = {.kind = kind, .limit = 0.01}, .budget = 3000};
          const auto tuned = tune_method(cell, m, seed, goal, {});
          ParameterMap values;
          for (const auto& p : tuned.parameters) values[p.name] = p.value;
          claims.add(tuned, measure_tuned(cell, m, seed, goal, values, goal.fresh,
                                          goal.fresh + further, {}));
        }
        all.add(claims);
        table.rows.push_back(
            claims.row(cell.name, cell.methods[m].id, TrialMeasure{kind, 0.01}.title()));
      }
  table.rows.push_back(all.row("all", "", ""));
  return {{"claims", table}};
}

}  // namespace
}  // namespace gyrostat

int main(int argc, char** argv) {
  using namespace gyrostat;
  const auto number = [&](int i, unsigned long fallback) {
    return i < argc ? std::strtoul(argv[i], nullptr, 10) : fallback;
  };
  const auto tables = tuning_coverage(static_cast<std::uint32_t>(number(1, 50)),
                                      static_cast<std::uint32_t>(number(2, 20000)), number(3, 1));
  for (const auto& [name, text] : page_files(tables))
    if (name == "tables.json") std::cout << text;
  for (const auto& named : tables) std::cerr << render({&named.table, 1}, Format::markdown);
}
