#include <cmath>
#include <filesystem>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/track.hpp>
#include <gyrostat/experiments/study/cell_parameters.hpp>
#include <gyrostat/experiments/study/digest.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/scenario_reading.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/experiments/study/study_ranges.hpp>

namespace gyrostat {
namespace {

const Json no_keys = Json::object();
constexpr double most_samples = 1e8;

/// "pieces": a recording whose part before "from_s" is calibrated on and whose rest is cut into
/// trials of "duration_s".
void read_pieces(JsonObject object, const std::string& folder, Cell& cell) {
  const RecordingSource source(object, folder);
  const double from_s = object.number("from_s", 300.0, ranges::positive, "s");
  const double duration_s = object.number("duration_s", 60.0, ranges::positive, "s");
  object.finish();
  const auto recording = source.read();
  cell.calibration_span = cut(recording.series, 0.0, from_s, object.place());
  cell.recording = std::make_shared<const Series>(
      cut(recording.series, from_s, recording.series.duration_s() + 1.0, object.place()));
  cell.scenario.sampling = {duration_s, cell.recording->rate_hz()};
  const auto pieces = cell.recording->size() / cell.scenario.sampling.samples();
  if (pieces == 0)
    throw InputError(object.place(),
                     fmt::format("no whole piece of {} s after {} s", duration_s, from_s));
  cell.trials = static_cast<std::uint32_t>(pieces);
  for (const auto& method : cell.methods)
    if (!method.tune.empty())
      throw InputError(object.place(), method.id + " cannot be tuned on the pieces that judge it");
  for (const auto& method : cell.methods) {
    const auto missing = missing_channels(method.type(object.place()).needs, *cell.recording);
    if (!missing.empty())
      throw InputError(object.place(), fmt::format("{} needs {}, which the recording has not",
                                                   method.id, fmt::join(missing, ", ")));
  }
}

CalibrationPlan read_calibration(JsonObject object) {
  CalibrationPlan plan;
  plan.method = object.named("fit", "likelihood", fit_method_named);
  plan.each_trial = object.number("each_trial", 0, ranges::flag, "1") != 0.0;
  plan.duration_s = object.number("duration_s", 0, ranges::positive, "s");
  object.finish();
  return plan;
}

TuningPlan read_tuning(JsonObject object) {
  TuningPlan plan;
  plan.metric = object.named("metric", "bias_rmse", metric_named);
  plan.trials =
      static_cast<std::uint32_t>(object.number("trials", 20, study_ranges::budget, "trials"));
  plan.evaluations =
      static_cast<int>(object.number("evaluations", 60, study_ranges::budget, "evaluations"));
  plan.undisturbed = object.number("undisturbed", 0, ranges::flag, "1") != 0.0;
  object.finish();
  return plan;
}

/// Factors by parameter name; any parameter of any filter may be misjudged.
ParameterMap read_assumed(JsonObject object) {
  ParameterMap factors;
  for (const auto& filter : filter_types())
    for (const auto& field : filter.fields) {
      const std::string name(field.name);
      if (object.has(name)) factors[name] = object.number(name, 1.0, ranges::any, "times");
    }
  object.finish();
  return factors;
}

/// Where filters have their parameters from, unless they say otherwise.
ParameterSource source_for_all(const std::string& name, const std::string& place) {
  const auto source = parameter_source_named(name, place);
  if (source == ParameterSource::defaults)
    throw InputError(place, "'defaults' is for single filters; allowed: calibration, truth");
  return source;
}

/// Refuses what no machine can hold and what no fit can use, before anything runs.
void check_size(const Cell& cell, JsonObject& object) {
  const auto& sampling = cell.scenario.sampling;
  if (sampling.duration_s * sampling.rate_hz > most_samples)
    throw InputError(object.place_of("scenario"),
                     fmt::format("duration_s x rate_hz is {:g} samples; allowed: up to {:g}",
                                 sampling.duration_s * sampling.rate_hz, most_samples));
  if (!cell.needs_calibration()) return;
  const double seconds =
      cell.calibration.duration_s > 0.0 ? cell.calibration.duration_s : sampling.duration_s;
  const double samples = cell.recording ? static_cast<double>(cell.calibration_span.size())
                                        : std::round(seconds * sampling.rate_hz);
  const double least = cell.calibration.method == FitMethod::likelihood ? 50 : 512;
  if (samples < least)
    throw InputError(
        object.place(),
        fmt::format("{} samples to calibrate on; at least {} are needed", samples, least));
}

Cell read_cell(JsonObject object, const std::string& folder, FittedRecordings& fits,
               std::size_t index) {
  Cell cell;
  cell.name = object.named("name", fmt::format("cell_{}", index + 1), plain_name);
  const bool sound = object.attempt([&] {
    cell.trials =
        static_cast<std::uint32_t>(object.number("trials", 1000, study_ranges::trials, "trials"));
    object.with_child("scenario", [&](JsonObject& scenario) {
      cell.scenario = read_scenario(scenario, folder, fits, &cell.fleet);
    });
    object.with_child("calibration",
                      [&](JsonObject& plan) { cell.calibration = read_calibration(plan); });
    cell.tuning = read_tuning(object.at(no_keys, object.place()));
    object.with_child("tuning", [&](JsonObject& plan) { cell.tuning = read_tuning(plan); });
    object.with_child("assumed",
                      [&](JsonObject& factors) { cell.assumed = read_assumed(factors); });
    cell.denoise = object.number("denoise", 0, ranges::flag, "1") != 0.0;
    const auto source = object.named("parameters_from", "calibration", source_for_all);
    const bool listed = object.attempt([&] {
      cell.methods =
          object.has("filters") ? read_methods(object, "filters", source) : all_methods(source);
    });
    if (listed && cell.methods.empty())
      object.complain(object.place_of("filters"), "the list is empty");
    object.with_child("pieces", [&](JsonObject& pieces) { read_pieces(pieces, folder, cell); });
    if (object.has("stop") && listed)
      object.with_child("stop", [&](JsonObject& stop) { cell.stop = read_stop(stop, cell); });
    if (object.has("failure") && listed)
      object.with_child("failure",
                        [&](JsonObject& rule) { cell.failure = read_failure(rule, cell); });
    object.finish();
  });
  if (sound) check_size(cell, object);
  return cell;
}

/// A study that grows, with the names that are taken.
struct GrowingStudy {
  Study study;
  std::unordered_set<std::string> names;

  void add(Cell cell, const std::string& place) {
    if (!names.insert(cell.name).second)
      throw InputError(place, "the name '" + cell.name + "' stands twice");
    study.cells.push_back(std::move(cell));
  }
};

/// Reads a cell and adds it. Its mistakes are told with the place of the cell that stands in the
/// file, so that one which all cells of a grid share is told once.
void add_read_cell(GrowingStudy& growing, const Json& cell, const std::string& place,
                   const std::string& written_place, const std::string& folder,
                   FittedRecordings& fits, Mistakes& mistakes) {
  Mistakes own;
  own.attempt([&] {
    const auto index = growing.study.cells.size();
    growing.add(read_cell({cell, place, &own}, folder, fits, index), place);
  });
  for (const auto& line : own.lines())
    mistakes.note(line.starts_with(place) ? written_place + line.substr(place.size()) : line);
}

/// Adds the cells that a "grid" or a "design" makes of one.
void add_design(GrowingStudy& growing, const Json& cell, const std::string& place,
                const std::string& folder, FittedRecordings& fits, Mistakes& mistakes) {
  auto& study = growing.study;
  if (cell.contains("grid") && cell.contains("design"))
    throw InputError(place,
                     "has a \"grid\" and a \"design\"; a design of kind \"grid\" is the same");
  Design design;
  if (cell.contains("grid")) {
    design = read_grid(cell, place, &mistakes);
  } else {
    Json base = cell;
    base.erase("design");
    Mistakes of_base;
    std::optional<Cell> read;
    of_base.attempt([&] {
      read = read_cell({base, place, &of_base}, folder, fits, study.cells.size());
    });
    if (read)
      of_base.attempt([&] { design = read_design(cell, *read, study.seed, place, &of_base); });
    for (const auto& line : of_base.lines()) mistakes.note(line);
    if (!of_base.lines().empty()) return;
  }
  if (design.is_sampled() && cell.contains("stop"))
    throw InputError(place + ".stop",
                     "all points of a design of this kind run as many trials; leave it out");
  design.first_cell = study.cells.size();
  for (const auto& [point, point_place] : cells_of(design, cell, place))
    add_read_cell(growing, point, point_place, place, folder, fits, mistakes);
  if (study.cells.size() == design.first_cell) return;
  const auto known = cell_parameters(study.cells[design.first_cell]);
  for (auto& parameter : design.parameters)
    for (const auto& k : known)
      if (k.path == parameter.path) parameter.unit = k.unit;
  study.designs.push_back(std::move(design));
}

}  // namespace

Study read_study(const std::string& path) {
  Mistakes mistakes;
  const Json json = read_json(path, &mistakes);
  return parse_study(json, path, std::move(mistakes));
}

Study parse_study(const Json& json, const std::string& path) {
  return parse_study(json, path, Mistakes{});
}

Study parse_study(const Json& json, const std::string& path, Mistakes mistakes) {
  JsonObject object(json, path + ":", &mistakes);
  const auto folder = std::filesystem::path(path).parent_path().string();
  GrowingStudy growing;
  auto& study = growing.study;
  FittedRecordings fits;
  object.has("$schema");  // for editors
  study.title = object.text("title", std::filesystem::path(path).stem().string());
  study.seed = static_cast<std::uint64_t>(object.number("seed", 1, study_ranges::seed, ""));
  study.failure_budget = object.number("failure_budget", 1.0, study_ranges::share, "of all trials");
  const bool cells_read = object.attempt([&] {
    for (const auto& [cell, place] : object.list("cells"))
      object.attempt([&] {
        if (cell->is_object() && (cell->contains("grid") || cell->contains("design")))
          add_design(growing, *cell, place, folder, fits, mistakes);
        else
          add_read_cell(growing, *cell, place, place, folder, fits, mistakes);
      });
  });
  if (cells_read && study.cells.empty()) mistakes.note(path + ": \"cells\" is missing or empty");
  object.finish();
  mistakes.raise();
  study.path = path;
  study.source = json.dump(2);
  study.digest = study_digest(json, path);
  return std::move(study);
}

}  // namespace gyrostat
