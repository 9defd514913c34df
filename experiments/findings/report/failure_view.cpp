#include <gyrostat/experiments/findings/report/failure_view.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/analysis/error_series.hpp>
#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/findings/report/places.hpp>
#include <gyrostat/experiments/run/trial.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_points = 300;

struct PlainValue {
  double value;
  std::uint32_t trial;
};

/// Of the trials that have a value of the rule's metric, the worst last.
std::vector<PlainValue> plain_values(const Store& store, std::uint32_t index, const Cell& cell,
                                     std::size_t method) {
  const auto& rule = *cell.failure;
  std::vector<PlainValue> values;
  store.for_each_trial(index, cell.trials, [&](const Store::TrialView& trial) {
    const double value =
        TrialOutcomes(trial.outcomes, cell.methods.size())[method].metric(rule.metric);
    if (!std::isnan(value)) values.push_back({value, trial.trial});
  });
  std::stable_sort(values.begin(), values.end(), [&](const PlainValue& a, const PlainValue& b) {
    return rule.badness(a.value) < rule.badness(b.value);
  });
  return values;
}

/// Errors over time of the cell's one method in the trial of `noise`, at evenly spaced times.
std::vector<double> errors_of(const PreparedCell& alone, const Noise& noise, bool heading,
                              std::vector<double>& t_s) {
  Workspace w;
  track_trial(alone.cell, alone.cell.methods[0], alone.calibration, noise, w);
  const auto headings =
      heading ? heading_errors_deg(judged_series(alone.cell, w.series, w.denoised), w.track)
              : std::vector<double>();
  std::vector<double> errors;
  t_s.clear();
  for (const std::size_t i : places(w.series.size(), most_points)) {
    t_s.push_back(w.series.t_s[i] - w.series.t_s.front());
    errors.push_back(heading ? headings[i] : bias_error_dps(w.series, w.track, i));
  }
  return errors;
}

}  // namespace

FailureView failure_view(const Study& study, const Store& plain, std::uint32_t index,
                         const std::filesystem::path& folder, const PreparedCell& prepared,
                         bool with_signals) {
  const auto& cell = study.cells[index];
  const auto& rule = *cell.failure;
  const bool heading = metric_types()[rule.metric].id.starts_with("heading");
  FailureView view{.findings = failure_findings(study, plain, index, folder),
                   .plain = {},
                   .signals = {},
                   .t_s = {},
                   .error = heading ? "heading error" : "estimate minus truth",
                   .unit = heading ? "deg" : "dps"};
  for (std::size_t f = 0; f < view.findings.size(); ++f) {
    const auto m = rule.methods[f];
    const auto values = plain_values(plain, index, cell, m);
    auto& only = view.plain.emplace_back();
    for (const auto& value : values) only.push_back(value.value);
    if (!with_signals || !view.findings[f].rare || values.empty()) continue;
    const auto signal = found_signal(study, index, m, prepared, folder);
    if (!signal) continue;
    auto alone = prepared;
    alone.cell.methods = {prepared.cell.methods[m]};
    const auto typical = values[values.size() / 2].trial;
    view.signals.push_back(
        {m, typical,
         errors_of(alone, Noise{failure_seed(study), 0, signal->shares}, heading, view.t_s),
         errors_of(alone, Noise{study.seed, typical, {}}, heading, view.t_s)});
  }
  return view;
}

}  // namespace gyrostat
