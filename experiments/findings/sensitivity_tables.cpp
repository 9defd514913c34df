#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/findings/sensitivity_words.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

std::int64_t count(std::size_t n) { return static_cast<std::int64_t>(n); }

std::string shown(const std::string& unit) { return unit == "1" ? "" : unit; }

/// "0.2 to 0.9 dps, log"
std::string span_of(const DesignParameter& p) {
  return fmt::format("{} to {}{}{}", short_number(p.from), short_number(p.to),
                     shown(p.unit).empty() ? "" : " " + p.unit, p.logarithmic ? ", log" : "");
}

void append(std::vector<TableCell>& row, const Estimate& e) {
  for (const double value : {e.value, e.low, e.high}) row.push_back(cell(value));
}

/// The head of a table of estimates.
Table begun(const Sensitivity& s, const std::string& what) {
  return {.title = fmt::format("{}: {} of {}", s.design, what, s.metric),
          .columns = {{"method", ""}, {"parameter", ""}, {"from, to", ""}}};
}

void add_columns(Table& table, const std::string& name, const std::string& unit) {
  table.columns.insert(table.columns.end(),
                       {{name, unit}, {name + " low", unit}, {name + " high", unit}});
}

std::vector<TableCell> begun_row(const Sensitivity& s, const Design& design, std::size_t p) {
  return {s.method, s.parameters[p], span_of(design.parameters[p])};
}

using OfDesign = std::vector<const Sensitivity*>;

Table elasticity_table(const OfDesign& methods, const Design& design) {
  const auto& first = *methods.front();
  auto table = begun(first, "elasticities");
  add_columns(table, "elasticity", "1");
  table.columns.insert(table.columns.end(), {{"at from", first.unit},
                                             {"at base", first.unit},
                                             {"at to", first.unit},
                                             {"failed", "trials"}});
  for (const auto* s : methods)
    for (std::size_t p = 0; p < s->parameters.size(); ++p) {
      const auto& e = s->elasticities[p];
      auto row = begun_row(*s, design, p);
      append(row, e.value);
      for (const double output : {e.low_output, s->means.front(), e.high_output})
        row.push_back(cell(output));
      row.emplace_back(count(s->failures[0] + s->failures[1 + 2 * p] + s->failures[2 + 2 * p]));
      table.rows.push_back(std::move(row));
    }
  table.notes.push_back(
      "elasticity: relative change of the mean per relative change of the parameter, from the "
      "slope between its two ends; 95 % intervals by Fieller and the bootstrap-t of trials, paired "
      "over "
      "the three points");
  return table;
}

Table morris_table(const OfDesign& methods, const Design& design) {
  const auto& first = *methods.front();
  auto table = begun(first, "elementary effects");
  add_columns(table, "mu*", first.unit);
  add_columns(table, "sigma", first.unit);
  table.columns.insert(table.columns.end(), {{"failed", "trials"}, {"left out", "steps"}});
  for (const auto* s : methods) {
    for (std::size_t p = 0; p < s->parameters.size(); ++p) {
      const auto& e = s->elementary_effects[p];
      auto row = begun_row(*s, design, p);
      append(row, e.mu_star);
      append(row, e.sigma);
      row.emplace_back(count(s->failed_trials()));
      row.emplace_back(count(e.left_out));
      table.rows.push_back(std::move(row));
    }
    table.rows.push_back({s->method, "trial noise", TableCell(), cell(s->noise.value), TableCell(),
                          TableCell(), TableCell(), TableCell(), TableCell(),
                          count(s->failed_trials()), TableCell()});
  }
  table.notes.push_back(
      "change of the mean over the parameter's whole span: mu* the mean of its size, sigma its "
      "spread over the design; the noise of the trials is taken out of both");
  table.notes.push_back(
      "trial noise: the mu* that a parameter without effect would show were it left in; intervals "
      "of mu* are wider by what may be left of it: more trials make them narrower");
  return table;
}

Table sobol_table(const OfDesign& methods, const Design& design) {
  auto table = begun(*methods.front(), "Sobol' indices");
  add_columns(table, "first order", "1");
  add_columns(table, "total", "1");
  table.columns.insert(table.columns.end(), {{"failed", "trials"}, {"left out", "rows"}});
  for (const auto* s : methods) {
    for (std::size_t p = 0; p < s->parameters.size(); ++p) {
      const auto& index = s->indices[p];
      auto row = begun_row(*s, design, p);
      append(row, index.first_order);
      append(row, index.total);
      row.emplace_back(count(s->failed_trials()));
      row.emplace_back(count(index.left_out));
      table.rows.push_back(std::move(row));
    }
    std::vector<TableCell> noise = {s->method, "trial noise", TableCell()};
    append(noise, s->noise);
    noise.insert(noise.end(),
                 {TableCell(), TableCell(), TableCell(), count(s->failed_trials()), TableCell()});
    table.rows.push_back(std::move(noise));
  }
  table.notes.push_back(
      "shares of the variance that the mean over trials has over the design; first order: of the "
      "parameter alone, total: with all its interactions; an index below 0 is one of 0 within "
      "its interval");
  table.notes.push_back(fmt::format(
      "trial noise: the variance that a mean over {} trials has by chance, as a share of "
      "the same variance; it is taken out of the indices",
      methods.front()->trials));
  return table;
}

std::string bootstrap_note(const OfDesign& methods) {
  return fmt::format(
      "{} of {}, {} without a finished trial; 95 % intervals by the bootstrap-t of "
      "rows and "
      "trials; failed: trials in which the method broke down or threw, over all points; left out: "
      "fewer "
      "than two trials have all of its points",
      counted(methods.front()->points, "point"), counted(methods.front()->trials, "trial"),
      methods.front()->failed_points);
}

/// What was computed of a design, method by method.
OfDesign of_design(const std::vector<Sensitivity>& all, const Design& design) {
  OfDesign methods;
  for (const auto& s : all)
    if (s.design == design.name) methods.push_back(&s);
  return methods;
}

TableCell value_cell(const std::string& text) {
  if (text.empty()) return {};
  const auto value = Json::parse(text);
  return value.is_number() ? cell(value.get<double>())
                           : TableCell(value.is_string() ? value.get<std::string>() : value.dump());
}

}  // namespace

bool has_sensitivities(DesignKind kind) {
  return kind == DesignKind::one_at_a_time || kind == DesignKind::morris ||
         kind == DesignKind::saltelli || kind == DesignKind::surrogate;
}

std::size_t Sensitivity::failed_trials() const {
  return std::accumulate(failures.begin(), failures.end(), std::size_t{0});
}

std::vector<Table> sensitivity_tables(const std::vector<Sensitivity>& all, const Study& study) {
  std::vector<Table> tables;
  for (const auto& design : study.designs) {
    const auto methods = of_design(all, design);
    if (methods.empty()) continue;
    if (!has_sensitivities(design.kind)) continue;
    tables.push_back(design.kind == DesignKind::one_at_a_time ? elasticity_table(methods, design)
                     : design.kind == DesignKind::morris      ? morris_table(methods, design)
                                                              : sobol_table(methods, design));
    auto& notes = tables.back().notes;
    if (design.kind != DesignKind::one_at_a_time) {
      notes.push_back(bootstrap_note(methods));
      if (methods.front()->trials == 1)
        notes.emplace_back(
            "a single trial tells nothing of its noise: it is part of what stands here");
    }
    std::vector<std::string> sentences;
    for (const auto* s : methods) sentences.push_back(sensitivity_sentence(*s));
    for (const auto* s : methods)
      if (s->surrogate) sentences.push_back(surrogate_verdict(*s));
    notes.insert(notes.begin(), sentences.begin(), sentences.end());
  }
  return tables;
}

std::vector<Table> point_tables(const std::vector<Sensitivity>& all, const Study& study) {
  std::vector<Table> tables;
  for (const auto& design : study.designs) {
    const auto methods = of_design(all, design);
    if (methods.empty()) continue;
    Table table{
        .title = fmt::format("{}: mean {} at each point", design.name, methods.front()->metric),
        .columns = {{"point", ""}}};
    for (const auto& p : design.parameters) table.columns.push_back({p.name, shown(p.unit)});
    for (const auto* s : methods)
      table.columns.insert(
          table.columns.end(),
          {{s->method, s->unit}, {"± " + s->method, s->unit}, {"failed " + s->method, "trials"}});
    for (std::size_t i = 0; i < design.values.size(); ++i) {
      auto& row = table.rows.emplace_back(std::vector<TableCell>{design.labels[i]});
      for (const auto& value : design.values[i]) row.push_back(value_cell(value));
      for (const auto* s : methods) {
        row.push_back(cell(s->means[i]));
        row.push_back(cell(s->standard_errors[i]));
        row.emplace_back(count(s->failures[i]));
      }
    }
    table.notes.push_back(fmt::format(
        "± one standard error of the mean over {} trials, the same random numbers at every "
        "point; failed trials stay in the mean where they have a value",
        methods.front()->trials));
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace gyrostat
