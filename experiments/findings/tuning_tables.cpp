#include <gyrostat/experiments/findings/tuning_tables.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/scenario_reading.hpp>
#include <gyrostat/results/render/interval.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

std::string tuned_unit(const TuningGoal& goal) {
  if (goal.measure.kind == TrialMeasure::Kind::probability) return "";
  return std::string(metric_types()[goal.metric].unit);
}

std::string measured_text(const TrialMeasure::Value& found, const TuningGoal& goal) {
  if (std::isnan(found.value)) return "no value";
  if (found.value == 0.0) return fmt::format("0 (to {:.2g})", found.high);
  auto text = std::isnan(found.low) ? fmt::format("{:.4g}", found.value)
                                    : with_interval(found.value, found.low, found.high);
  const auto unit = tuned_unit(goal);
  return unit.empty() ? text : text + " " + unit;
}

/// "bias_rmse, mean".
std::string tuned_by(const TuningGoal& goal) {
  return fmt::format("{}, {}", metric_types()[goal.metric].id, goal.measure.title());
}

/// The best on fresh trials as it would be used; null where none has a value.
const MethodTuning* best_of(const CellTuning& cell) {
  const auto value = [](const MethodTuning& m) {
    return m.is_better() ? m.after.value : m.before.value;
  };
  const MethodTuning* best = nullptr;
  for (const auto& m : cell.methods)
    if (!std::isnan(value(m)) && (best == nullptr || value(m) < value(*best))) best = &m;
  return best;
}

std::string gain_sentence(const MethodTuning& m, const TuningGoal& goal) {
  const auto metric = metric_types()[goal.metric].id;
  const auto how = fmt::format("{} of {} fresh trials", goal.measure.title(), goal.fresh);
  if (std::isnan(m.after.value)) return m.method + " has no value in any fresh trial.";
  if (!m.is_better())
    return fmt::format(
        "Tuning {} gains nothing that fresh trials tell: its {} is {} tuned and {} as "
        "it was ({}).",
        m.method, metric, measured_text(m.after, goal), measured_text(m.before, goal), how);
  return fmt::format("Tuned, {} has a {} of {}; it was {} ({}).", m.method, metric,
                     measured_text(m.after, goal), measured_text(m.before, goal), how);
}

std::string flat_sentence(const MethodTuning& m) {
  std::vector<std::string> flat, counts;
  for (const auto& p : m.parameters) (p.matters ? counts : flat).push_back(p.name);
  if (counts.empty()) return "None of its parameters matters within the range searched.";
  auto text =
      fmt::format("{} {}", fmt::join(counts, ", "), counts.size() == 1 ? "matters" : "matter");
  if (!flat.empty())
    text += fmt::format("; {} {} not", fmt::join(flat, ", "), flat.size() == 1 ? "does" : "do");
  return text + ".";
}

Table methods_table(const CellTuning& cell, const TuningGoal& goal) {
  const auto unit = tuned_unit(goal);
  Table table{
      .title = fmt::format("{}: {} on {} fresh trials", cell.name, tuned_by(goal), goal.fresh),
      .columns = {{"method", ""},
                  {"was", unit},
                  {"tuned", unit},
                  {"from", unit},
                  {"to", unit},
                  {"gain", unit},
                  {"better", ""}}};
  for (const auto& m : cell.methods) {
    table.rows.push_back({m.method, gyrostat::cell(m.before.value), gyrostat::cell(m.after.value),
                          gyrostat::cell(m.after.low), gyrostat::cell(m.after.high),
                          gyrostat::cell(m.gain.mean),
                          std::string(m.is_better() ? "yes" : "not told")});
    if (m.after.missing > 0)
      table.notes.push_back(
          fmt::format("{}: no value in {} of the fresh trials", m.method, m.after.missing));
  }
  table.notes.push_back(
      "tuned, from, to: what is claimed, with its 95 % interval, of trials that no search has "
      "seen");
  for (const auto& m : cell.methods)
    table.notes.push_back(
        fmt::format("{}: {} runs; on the trials of its search, which flatter: {:.4g}", m.method,
                    m.runs, m.on_search));
  return table;
}

Table parameters_table(const CellTuning& cell, const MethodTuning& m) {
  Table table{.title = fmt::format("{}: {}: parameters", cell.name, m.method),
              .columns = {{"parameter", ""},
                          {"was", ""},
                          {"tuned", ""},
                          {"from", ""},
                          {"to", ""},
                          {"matters", ""}}};
  for (const auto& p : m.parameters)
    table.rows.push_back({p.name, gyrostat::cell(p.before), gyrostat::cell(p.value),
                          gyrostat::cell(p.low), gyrostat::cell(p.high),
                          std::string(p.matters ? "yes" : "no")});
  table.notes.push_back(
      "from, to: with the others held, fresh trials tell what lies beyond as worse (95 %); or the "
      "ends of what was searched");
  std::vector<std::string> at_an_end;
  for (const auto& p : m.parameters)
    if (p.matters && (p.value == p.range.low || p.value == p.range.high))
      at_an_end.push_back(p.name);
  if (!at_an_end.empty())
    table.notes.push_back(
        fmt::format("best at an end of what was searched, which --range widens: {}",
                    fmt::join(at_an_end, ", ")));
  return table;
}

Table flatness_table(const CellTuning& cell, const MethodTuning& m) {
  Table table{
      .title = fmt::format("{}: {}: how flat it is", cell.name, m.method),
      .columns = {{"parameter", ""}, {"at", ""}, {"worse by", "%"}, {"from", "%"}, {"to", "%"}}};
  const auto percent = [&](double growth) {
    return gyrostat::cell(100.0 * growth / std::abs(m.after.value));
  };
  for (const auto& p : m.parameters)
    for (const auto& [end, growth] :
         {std::pair(p.range.low, &p.at_low), std::pair(p.range.high, &p.at_high)})
      table.rows.push_back(
          {p.name, end, percent(growth->mean), percent(growth->low), percent(growth->high)});
  table.notes.push_back(
      "one parameter at an end of its range, the others tuned; a parameter matters where that is "
      "told as worse, by more than 1 %");
  return table;
}

Table curve_table(const CellTuning& cell, const MethodTuning& m, const TuningGoal& goal) {
  const auto unit = tuned_unit(goal);
  Table table{.title = fmt::format("{}: {}: the best so far", cell.name, m.method),
              .columns = {{"stage", ""},
                          {"candidates", ""},
                          {"trials", ""},
                          {"runs", ""},
                          {"best", unit},
                          {"from", unit},
                          {"to", unit}}};
  for (const auto& s : m.curve)
    table.rows.push_back({s.what, static_cast<std::int64_t>(s.candidates),
                          static_cast<std::int64_t>(s.trials), static_cast<std::int64_t>(s.runs),
                          gyrostat::cell(s.fresh.value), gyrostat::cell(s.fresh.low),
                          gyrostat::cell(s.fresh.high)});
  table.notes.push_back(
      "best: the best of each stage on the fresh trials, by which none was chosen");
  return table;
}

Json value_json(const TrialMeasure::Value& found) {
  return {{"value", found.value},
          {"low", found.low},
          {"high", found.high},
          {"trials", found.trials},
          {"missing", found.missing}};
}

Json method_json(const MethodTuning& m) {
  Json json = {
      {"method", m.method},           {"better", m.is_better()},  {"before", value_json(m.before)},
      {"tuned", value_json(m.after)}, {"gain", m.gain.mean},      {"gain_low", m.gain.low},
      {"gain_high", m.gain.high},     {"on_search", m.on_search}, {"runs", m.runs},
  };
  for (const auto& p : m.parameters)
    json["parameters"][p.name] = {{"unit", p.unit},
                                  {"before", p.before},
                                  {"value", p.value},
                                  {"low", p.low},
                                  {"high", p.high},
                                  {"searched", {p.range.low, p.range.high}},
                                  {"growth_at_low", p.at_low.mean},
                                  {"growth_at_high", p.at_high.mean},
                                  {"matters", p.matters}};
  for (const auto& s : m.curve)
    json["curve"].push_back({{"stage", s.what},
                             {"candidates", s.candidates},
                             {"trials", s.trials},
                             {"runs", s.runs},
                             {"fresh", value_json(s.fresh)}});
  return json;
}

/// The entry of a study's list of filters, an object where it was a name, with what was tuned.
void give_values(Json& entry, const MethodTuning& m) {
  if (entry.is_string()) entry = {{"filter", entry}};
  entry.erase("tune");
  for (const auto& p : m.parameters) entry["parameters"][p.name] = p.value;
}

}  // namespace

std::string tuning_in_words(const std::vector<CellTuning>& all, const TuningGoal& goal) {
  std::size_t tuned = 0, better = 0, cells = 0;
  const CellTuning* only = nullptr;
  for (const auto& cell : all) {
    if (cell.methods.empty()) continue;
    ++cells;
    only = &cell;
    for (const auto& m : cell.methods) {
      ++tuned;
      better += m.is_better();
    }
  }
  if (tuned == 0) return "";
  if (tuned == 1)
    return gain_sentence(only->methods.front(), goal) + " " + flat_sentence(only->methods.front());
  auto text = fmt::format("Tuning makes {} of {} methods better ({}, {} fresh trials).", better,
                          tuned, tuned_by(goal), goal.fresh);
  const auto* best = best_of(*only);
  if (cells == 1 && best != nullptr)
    text += fmt::format(
        " The best is then {}: {}{}.", best->method,
        measured_text(best->is_better() ? best->after : best->before, goal),
        best->is_better() ? "; it was " + measured_text(best->before, goal) : ", as it was");
  return text;
}

std::vector<Table> tuning_tables(const std::vector<CellTuning>& all, const TuningGoal& goal) {
  std::vector<Table> tables;
  for (const auto& cell : all) {
    if (cell.methods.empty()) continue;
    tables.push_back(methods_table(cell, goal));
    for (const auto& m : cell.methods) {
      tables.push_back(parameters_table(cell, m));
      tables.push_back(flatness_table(cell, m));
      tables.push_back(curve_table(cell, m, goal));
    }
  }
  return tables;
}

Json tuning_json(const std::vector<CellTuning>& all, const TuningGoal& goal) {
  Json json = {{"metric", metric_types()[goal.metric].id},
               {"measure", goal.measure.title()},
               {"unit", tuned_unit(goal)},
               {"budget", goal.budget},
               {"fresh_trials", goal.fresh},
               {"cells", Json::array()}};
  for (const auto& cell : all) {
    Json methods = Json::array();
    for (const auto& m : cell.methods) methods.push_back(method_json(m));
    json["cells"].push_back({{"cell", cell.name}, {"methods", std::move(methods)}});
  }
  return json;
}

Json with_tuned_values(const Study& study, const std::vector<CellTuning>& all,
                       const std::string& out) {
  Json json = Json::parse(study.source);
  const auto folder = fs::absolute(study.path).parent_path();
  const auto out_folder = fs::absolute(out).parent_path();
  for (auto& cell : json["cells"])
    for (const auto* source : scenario_sources) {
      if (!cell.contains("scenario") || !cell["scenario"].contains(source)) continue;
      auto& file = cell["scenario"][source]["file"];
      const auto path = (folder / file.get<std::string>()).lexically_normal();
      file = path.lexically_proximate(out_folder.lexically_normal()).string();
    }
  for (const auto& tuning : all) {
    auto& cell = json["cells"][tuning.cell];
    const auto& methods = study.cells[tuning.cell].methods;
    if (!cell.contains("filters"))
      for (const auto& method : methods) cell["filters"].push_back(method.id);
    for (const auto& m : tuning.methods)
      for (std::size_t i = 0; i < methods.size() && m.is_better(); ++i)
        if (methods[i].id == m.method) give_values(cell["filters"][i], m);
  }
  return json;
}

}  // namespace gyrostat
