#include <gyrostat/experiments/findings/failure_sensitivity.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/outcome.hpp>
#include <gyrostat/experiments/findings/failures.hpp>

namespace gyrostat {
namespace {

/// Of a method whose plain trials tell its failure: the share that fails in each of `parts`.
std::vector<double> plain_shares(const Store& plain, std::uint32_t index, const Cell& cell,
                                 std::size_t method, std::size_t parts) {
  std::vector<double> failing(parts, 0.0), count(parts, 0.0);
  const auto& rule = *cell.failure;
  plain.for_each_trial(index, cell.trials, [&](const Store::TrialView& trial) {
    const auto outcome = TrialOutcomes(trial.outcomes, cell.methods.size())[method];
    count[trial.trial % parts] += 1.0;
    failing[trial.trial % parts] +=
        rule.badness(outcome.metric(rule.metric)) > rule.worst_allowed();
  });
  for (std::size_t p = 0; p < parts; ++p) failing[p] /= count[p];
  return failing;
}

/// A point's probability, one a replicate; NaN where it is not told.
std::vector<double> probabilities(const Cell& cell, const FailureFinding& finding,
                                  const Store& plain, std::uint32_t index, std::size_t method) {
  std::vector<double> values(cell.failure->runs, 0.0);
  if (finding.rare)
    for (std::size_t r = 0; r < values.size(); ++r)
      values[r] = finding.search->runs()[r].probability();
  else if (finding.plain.is_enough())
    values = plain_shares(plain, index, cell, method, values.size());
  for (double& v : values)
    if (v == 0.0) v = no_value;
  return values;
}

}  // namespace

std::vector<Sensitivity> failure_sensitivities(const Study& study, const Store& plain,
                                               const std::filesystem::path& folder) {
  const auto searches = failure_store(study, folder);
  std::vector<Sensitivity> all;
  for (const auto& design : study.designs) {
    const auto& first = study.cells[design.first_cell];
    if (!first.failure) continue;
    const auto& methods = first.failure->methods;
    const std::size_t points = design.values.size();
    // An elasticity is of logarithms by itself.
    const bool relative = design.kind == DesignKind::one_at_a_time;
    std::vector<DesignOutputs> outputs(methods.size(), {Outputs(points, first.failure->runs)});
    for (std::size_t i = 0; i < points; ++i) {
      const auto index = static_cast<std::uint32_t>(design.first_cell + i);
      const auto& cell = study.cells[index];
      const auto findings = failure_findings(study, plain, index, searches);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        auto values = probabilities(cell, findings[m], plain, index, methods[m]);
        if (!relative)
          for (double& v : values) v = std::log10(v);
        outputs[m].add_point(values);
        outputs[m].failed.push_back(0);
        for (std::size_t r = 0; r < values.size(); ++r) outputs[m].outputs.at(i, r) = values[r];
      }
    }
    Resampler resampler(study.seed, "bootstrap/failure/" + design.name);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const auto& id = first.methods[methods[m]].id;
      all.push_back(sensitivity_of(
          design, id, relative ? "probability of failure" : "log10 of the probability of failure",
          relative ? "1" : "decades", outputs[m], resampler));
    }
  }
  return all;
}

}  // namespace gyrostat
