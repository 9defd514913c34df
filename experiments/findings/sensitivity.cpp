#include <gyrostat/experiments/findings/sensitivity.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/sensitivity/estimators.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/core/outcome.hpp>
#include <gyrostat/experiments/findings/cell_summary.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

/// More trials than these are averaged in so many groups: trial t belongs to group t mod
/// most_groups.
constexpr std::size_t most_groups = 100;

/// The metric of each of `methods`, in one pass over the design's trials.
std::vector<DesignOutputs> collect(const Study& study, const CellTrials& trials_of,
                                   const Design& design, const std::vector<std::size_t>& methods,
                                   std::size_t metric) {
  const std::size_t points = design.values.size();
  const std::uint32_t trials = study.cells[design.first_cell].trials;
  const std::size_t groups = std::min<std::size_t>(trials, most_groups);
  std::vector<DesignOutputs> all(methods.size(), {.outputs = Outputs(points, groups)});
  std::vector<std::vector<double>> values(methods.size()), sums(methods.size()),
      counts(methods.size());
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      all[m].failed.push_back(0);
      values[m].clear();
      sums[m].assign(groups, 0.0);
      counts[m].assign(groups, 0.0);
    }
    trials_of(design.first_cell + i, [&](std::uint32_t trial, std::span<const double> numbers) {
      const TrialOutcomes outcomes(numbers, study.cells[design.first_cell].methods.size());
      for (std::size_t m = 0; m < methods.size(); ++m) {
        const Outcome outcome = outcomes[methods[m]];
        all[m].failed.back() += outcome.has_failed();
        const double value = outcome.metric(metric);
        values[m].push_back(value);
        if (std::isnan(value)) continue;
        sums[m][trial % groups] += value;
        counts[m][trial % groups] += 1.0;
      }
    });
    for (std::size_t m = 0; m < methods.size(); ++m) {
      auto& c = all[m];
      c.add_point(values[m]);
      for (std::size_t g = 0; g < groups; ++g) c.outputs.at(i, g) = sums[m][g] / counts[m][g];
    }
  }
  return all;
}

/// The coordinate of a point's parameter; NaN where the value is no number.
double number_of(const std::string& text) {
  const auto value = Json::parse(text, nullptr, false);
  return value.is_number() ? value.get<double>() : no_value;
}

void estimate(const Design& design, const Outputs& outputs, Resampler& resampler, Sensitivity& s) {
  const std::size_t parameters = design.parameters.size();
  if (design.kind == DesignKind::one_at_a_time) {
    std::vector<Excursion> excursions;
    for (std::size_t p = 0; p < parameters; ++p) {
      const auto& [from, to] = std::tie(design.parameters[p].from, design.parameters[p].to);
      excursions.push_back(design.parameters[p].logarithmic
                               ? Excursion{1.0, std::log(from), std::log(to)}
                               : Excursion{design.base[p], from, to});
    }
    s.elasticities = elasticities(outputs, excursions, resampler);
    for (std::size_t p = 0; p < parameters; ++p) s.elasticities[p].parameter = s.parameters[p];
  }
  if (design.kind == DesignKind::morris) {
    const double step = morris_step(design.levels);
    s.elementary_effects = elementary_effects(design.points, outputs, step, resampler);
    for (std::size_t p = 0; p < parameters; ++p)
      s.elementary_effects[p].parameter = s.parameters[p];
    s.noise.value = elementary_noise(design.points, outputs, step);
  }
  if (design.kind == DesignKind::saltelli || design.kind == DesignKind::surrogate) {
    if (design.kind == DesignKind::surrogate) {
      std::vector<std::size_t> levels;
      for (const auto& p : design.parameters) levels.push_back(p.level_count());
      s.surrogate = surrogate_of(design.points, levels, outputs, resampler);
      s.indices.swap(s.surrogate->indices);
    } else {
      s.indices = sobol_indices(parameters, outputs, resampler);
    }
    s.noise = s.indices.back().first_order;
    s.indices.pop_back();
    for (std::size_t p = 0; p < parameters; ++p) s.indices[p].parameter = s.parameters[p];
  }
}

}  // namespace

void DesignOutputs::add_point(std::span<const double> values) {
  const auto summary = summarise(values);
  means.push_back(summary.mean);
  standard_errors.push_back(summary.std / std::sqrt(static_cast<double>(summary.count)));
  missing += summary.missing;
  most = std::max(most, values.size());
  empty_points += summary.count == 0;
}

Sensitivity sensitivity_of(const Design& design, const std::string& method, const std::string& name,
                           const std::string& unit, const DesignOutputs& outputs,
                           Resampler& resampler) {
  Sensitivity s{.design = design.name,
                .kind = name_of(design.kind),
                .method = method,
                .metric = name,
                .unit = unit,
                .trials = outputs.most,
                .missing_values = outputs.missing,
                .points = design.values.size(),
                .failed_points = outputs.empty_points,
                .failures = outputs.failed};
  for (const auto& parameter : design.parameters) {
    s.parameters.push_back(parameter.name);
    s.units.push_back(parameter.unit);
  }
  for (const auto& point : design.values) {
    auto& row = s.coordinates.emplace_back();
    for (const auto& value : point) row.push_back(number_of(value));
  }
  s.labels = design.labels;
  s.means = outputs.means;
  s.standard_errors = outputs.standard_errors;
  estimate(design, outputs.outputs, resampler, s);
  return s;
}

std::vector<Sensitivity> sensitivities(const Study& study, const Store& store) {
  return sensitivities(study, store, {});
}

std::vector<Sensitivity> sensitivities(const Study& study, const Store& store,
                                       const SensitivityChoice& choice) {
  const auto trials = [&](std::size_t cell, const auto& visit) {
    store.for_each_trial(
        static_cast<std::uint32_t>(cell), study.cells[cell].trials,
        [&](const Store::TrialView& trial) { visit(trial.trial, trial.outcomes); });
  };
  return sensitivities(study, trials, choice);
}

std::vector<Sensitivity> sensitivities(const Study& study, const CellTrials& trials,
                                       const SensitivityChoice& choice) {
  std::vector<Sensitivity> all;
  bool known = choice.method.empty();
  std::vector<std::string> ids;
  for (const auto& design : study.designs) {
    const auto& cell = study.cells[design.first_cell];
    const std::string name =
        choice.metric.empty() ? std::string(judging_metric(cell)) : choice.metric;
    const std::size_t metric = metric_named(name, "--metric");
    std::vector<std::size_t> methods;
    for (std::size_t m = 0; m < cell.methods.size(); ++m) {
      ids.push_back(cell.methods[m].id);
      if (choice.method.empty() ? !cell.methods[m].role().is_bound()
                                : cell.methods[m].id == choice.method)
        methods.push_back(m);
    }
    known = known || !methods.empty();
    const auto collected = collect(study, trials, design, methods, metric);
    Resampler resampler(study.seed, "bootstrap/" + design.name);
    for (std::size_t m = 0; m < methods.size(); ++m)
      all.push_back(sensitivity_of(design, cell.methods[methods[m]].id, name,
                                   std::string(metric_types()[metric].unit), collected[m],
                                   resampler));
  }
  if (!known) throw InputError("--method", unknown_name("method", choice.method, ids));
  return all;
}

}  // namespace gyrostat
