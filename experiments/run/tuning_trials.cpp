#include <gyrostat/experiments/run/tuning_trials.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/error_metric.hpp>
#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/experiments/run/method_tuning.hpp>

namespace gyrostat {
namespace {

/// Seeds of trials that no study meets: fixed bits, far from those that people choose and from the
/// inverted ones of calibrations.
constexpr std::uint64_t of_the_search = 0x5ea2c40000000000, of_the_judges = 0x7d0ed00000000000;

PreparedCell untuned(Cell cell, std::uint64_t seed, int threads) {
  for (auto& method : cell.methods) method.tune.clear();
  return prepare_cell(cell, seed, threads);
}

/// Its values in the cell, by the shared calibration.
std::vector<double> values_in(const PreparedCell& prepared, const Method& method) {
  Series start;
  Scenario brief = prepared.cell.scenario;
  brief.sampling.duration_s = 2.0 / brief.sampling.rate_hz;
  synthesise(brief, {}, start);
  return field_values(method.type(),
                      told_parameters(prepared.cell, brief, method, prepared.calibration, start),
                      method.overrides);
}

const FieldInfo* field_of(const Method& method, const std::string& name) {
  const auto fields = method.type().fields;
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

/// The whole of a finite range without its open ends.
SearchRange closed(const Range& range) {
  const double margin = 1e-3 * (range.to - range.from);
  return {range.from + range.open_from * margin, range.to - range.open_to * margin, range.whole};
}

bool is_measured_or_chosen(const FieldInfo& field) {
  const auto drift = ThermalDrift<double>::fields();
  return field.name.starts_with("initial_") ||
         (field.range.whole && field.range.from == 0.0 && field.range.to == 1.0) ||
         std::any_of(drift.begin(), drift.end(),
                     [&](const auto& f) { return f.name == field.name; });
}

/// By default, around a value.
SearchRange range_about(double value, const Range& own) {
  constexpr double decade = 10.0, thrice = 3.0;
  if (own.from < 0.0 && std::isfinite(own.from) && std::isfinite(own.to)) return closed(own);
  if (value == 0.0 || !std::isfinite(value)) return {0.0, 0.0};
  SearchRange range{value / decade, value * decade, own.whole};
  if (own.from < 0.0)
    range = {value - thrice * std::abs(value), value + thrice * std::abs(value), own.whole};
  range.low = std::max(range.low, own.from);
  range.high =
      own.open_to && range.high >= own.to ? own.to * (1.0 - 1e-3) : std::min(range.high, own.to);
  return range;
}

}  // namespace

std::map<std::string, SearchRange> tuning_ranges(const PreparedCell& prepared,
                                                 const Method& method) {
  if (!method.tune.empty()) return method.tune;
  std::map<std::string, SearchRange> ranges;
  const auto values = values_in(prepared, method);
  const auto fields = method.type().fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (is_measured_or_chosen(fields[i])) continue;
    const auto range = range_about(values[i], fields[i].range);
    if (range.low < range.high) ranges[std::string(fields[i].name)] = range;
  }
  return ranges;
}

TuningTrials::TuningTrials(const Cell& cell, std::size_t method, std::uint64_t seed,
                           std::size_t metric, const RunOptions& options)
    : method_(cell.methods[method]), seed_(seed), metric_(metric), options_(options) {
  if (cell.recording)
    throw InputError(cell.name,
                     "a method cannot be tuned on the pieces that judge it; "
                     "\"from_recording\" in a scenario makes trials around a recording");
  prepared_ = untuned(cell, seed, options.threads);
}

bool TuningTrials::has(const std::string& parameter) const {
  return field_of(method_, parameter) != nullptr;
}

std::string TuningTrials::unit_of(const std::string& parameter) const {
  return std::string(field_of(method_, parameter)->unit);
}

double TuningTrials::value_of(const std::string& parameter) const {
  const auto at = field_of(method_, parameter) - method_.type().fields.data();
  return values_in(prepared_, method_)[static_cast<std::size_t>(at)];
}

std::vector<std::vector<double>> TuningTrials::search(const std::vector<ParameterMap>& candidates,
                                                      std::size_t first, std::size_t last,
                                                      const Done& done) const {
  return run(candidates, seed_ ^ of_the_search, first, last, done);
}

std::vector<std::vector<double>> TuningTrials::fresh(const std::vector<ParameterMap>& candidates,
                                                     std::size_t first, std::size_t last,
                                                     const Done& done) const {
  return run(candidates, seed_ ^ of_the_judges, first, last, done);
}

std::vector<std::vector<double>> TuningTrials::run(const std::vector<ParameterMap>& candidates,
                                                   std::uint64_t seed, std::size_t first,
                                                   std::size_t last, const Done& done) const {
  PreparedCell prepared = prepared_;
  prepared.cell.trials = static_cast<std::uint32_t>(last);
  prepared.cell.methods.assign(candidates.size(), method_);
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (const auto& [name, value] : candidates[c])
      prepared.cell.methods[c].overrides[name] = value;
  std::vector<std::vector<double>> errors(candidates.size(),
                                          std::vector<double>(last - first, no_value));
  RunOptions options = options_;
  options.progress = done;
  run_trials(
      prepared, seed, options, [&](std::uint32_t trial) { return trial >= first; },
      [&](std::uint32_t trial, Record&& record) {
        for (std::size_t c = 0; c < candidates.size(); ++c)
          errors[c][trial - first] = error_of(metric_, record.of(c).metric(metric_));
      });
  if (options.stop != nullptr && *options.stop) throw Interrupted();
  return errors;
}

}  // namespace gyrostat
