#include <gyrostat/experiments/pages/ledger.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/paired.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/findings/ranking_words.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/results/render/interval.hpp>

namespace gyrostat {
namespace {

std::size_t method_index(const Cell& cell, const std::string& id) {
  const auto found = std::find_if(cell.methods.begin(), cell.methods.end(),
                                  [&](const Method& m) { return m.id == id; });
  return static_cast<std::size_t>(found - cell.methods.begin());
}

bool concerns(const Claim& claim, const std::string& study, const Cell& cell) {
  if (claim.study != study) return false;
  return claim.cells.empty() ||
         std::find(claim.cells.begin(), claim.cells.end(), cell.name) != claim.cells.end();
}

std::vector<double> values_for(const Claim& claim, const CellResult& result, std::size_t method) {
  auto values = metric_values(result, method, claim.metric);
  if (claim.absolute)
    for (double& v : values) v = std::abs(v);
  return values;
}

/// The cell with those of its methods that a claim of the study names: the others change nothing.
Cell with_named_methods(const Ledger& ledger, const std::string& study, const Cell& cell) {
  Cell wanted = cell;
  std::erase_if(wanted.methods, [&](const Method& method) {
    return std::none_of(ledger.claims.begin(), ledger.claims.end(), [&](const Claim& claim) {
      return claim.study == study && (claim.method == method.id || claim.than == method.id);
    });
  });
  return wanted;
}

/// A cell with what came out of it.
struct Done {
  Cell cell;
  CellResult result;
};

Finding judge_one(const Claim& claim, const Done& done, const Done& other, std::size_t family) {
  const Cell& cell = done.cell;
  const auto values = values_for(claim, done.result, method_index(cell, claim.method));
  const auto& rival = claim.than.empty() ? claim.method : claim.than;
  const auto against = claim.than.empty() && claim.than_cell.empty()
                           ? std::vector<double>(values.size(), claim.value)
                           : values_for(claim, other.result, method_index(other.cell, rival));
  const auto d = paired_difference(values, against, family);
  const auto own = summarise(values);
  Finding finding{.cell = cell.name,
                  .mean = own.mean,
                  .mean_half_width = own.half_width_95,
                  .quantity = d.mean,
                  .low = d.low,
                  .high = d.high,
                  .trials_needed = d.trials_needed,
                  .trials = d.count};
  const double towards = claim.above ? d.mean : -d.mean;
  if (d.low == 0.0 && d.high == 0.0) finding.verdict = Verdict::equal;
  if (d.separable) finding.verdict = towards > 0.0 ? Verdict::holds : Verdict::does_not_hold;
  return finding;
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::does_not_hold:
      return "does not hold";
    case Verdict::equal:
      return "equal";
    default:
      return "not separable";
  }
}

std::string statement(const Claim& claim) {
  const auto metric = metric_types()[claim.metric].id;
  const auto subject = fmt::format("{}{}{} of {}", claim.absolute ? "|" : "", metric,
                                   claim.absolute ? "|" : "", claim.method);
  const auto place = claim.than_cell.empty() ? "" : " in " + claim.than_cell;
  const auto object = !claim.than.empty() ? "that of " + claim.than + place
                      : place.empty()     ? fmt::format("{:g}", claim.value)
                                          : "its own" + place;
  return fmt::format("{} {} {}", subject, claim.above ? "above" : "below", object);
}

/// The difference with its interval, or the least and the greatest of several.
std::string differences_of(const std::vector<const Finding*>& findings) {
  if (findings.empty()) return "";
  const auto text = [](const Finding& f) { return with_interval(f.quantity, f.low, f.high); };
  const auto [low, high] = std::minmax_element(
      findings.begin(), findings.end(),
      [](const Finding* a, const Finding* b) { return a->quantity < b->quantity; });
  return *low == *high ? text(**low) : text(**low) + " … " + text(**high);
}

std::string summary_of(const std::vector<const Finding*>& findings) {
  if (findings.empty()) return "not run";
  std::vector<std::string> where, elsewhere;
  for (const auto* f : findings)
    (f->verdict == Verdict::holds ? where : elsewhere).push_back(f->cell);
  const auto all = [&](Verdict verdict) {
    return std::all_of(findings.begin(), findings.end(),
                       [&](const Finding* f) { return f->verdict == verdict; });
  };
  for (const auto verdict :
       {Verdict::holds, Verdict::does_not_hold, Verdict::not_separable, Verdict::equal})
    if (all(verdict)) return name_of(verdict);
  if (where.empty()) return "does not hold, or not separable";
  if (elsewhere.size() < where.size())
    return fmt::format("holds in {} of {}, not in {}", where.size(), findings.size(),
                       fmt::join(elsewhere, ", "));
  return fmt::format("holds only in {}", fmt::join(where, ", "));
}

}  // namespace

Ledger read_ledger(const std::string& path) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  const auto folder = std::filesystem::path(path).parent_path();
  Ledger ledger;
  ledger.title = object.text("title", path);
  for (const auto& [value, place] : object.list("claims")) {
    JsonObject entry(*value, place);
    Claim claim;
    claim.text = entry.text("claim", "");
    claim.source = entry.text("source", "");
    claim.study = (folder / entry.text("study", "")).lexically_normal().string();
    claim.method = entry.text("method", "");
    claim.than = entry.text("than", "");
    claim.than_cell = entry.text("than_cell", "");
    claim.value = entry.number("value", 0.0, ranges::any, "");
    claim.metric = metric_named(entry.text("metric", ""), entry.place_of("metric"));
    claim.absolute = entry.number("absolute", 0, ranges::flag, "") != 0.0;
    claim.above = entry.number("above", 0, ranges::flag, "") != 0.0;
    for (const auto& [cell, cell_place] : entry.list("cells")) {
      if (!cell->is_string()) throw InputError(cell_place, "the name of a cell is needed here");
      claim.cells.push_back(cell->get<std::string>());
    }
    entry.finish();
    const Study study = read_study(claim.study);
    std::vector<std::string> names;
    for (const auto& cell : study.cells) names.push_back(cell.name);
    for (const auto& name : claim.cells)
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw InputError(place, unknown_name("cell", name, names));
    if (!claim.than_cell.empty() &&
        std::find(names.begin(), names.end(), claim.than_cell) == names.end())
      throw InputError(entry.place_of("than_cell"), unknown_name("cell", claim.than_cell, names));
    const auto require = [&](const Cell& cell, const std::string& id) {
      if (method_index(cell, id) == cell.methods.size())
        throw InputError(place, fmt::format("cell {} has no method '{}'", cell.name, id));
    };
    const auto& rival = claim.than.empty() ? claim.method : claim.than;
    for (const auto& cell : study.cells) {
      if (concerns(claim, claim.study, cell)) require(cell, claim.method);
      if (claim.than_cell.empty() ? concerns(claim, claim.study, cell)
                                  : cell.name == claim.than_cell)
        require(cell, rival);
    }
    if (std::find(ledger.studies.begin(), ledger.studies.end(), claim.study) ==
        ledger.studies.end())
      ledger.studies.push_back(claim.study);
    ledger.claims.push_back(claim);
  }
  object.finish();
  if (ledger.claims.empty()) throw InputError(path, "\"claims\" is missing or empty");
  return ledger;
}

std::vector<Finding> judge(const Ledger& ledger,
                           const std::function<CellResult(const Study&, const Cell&)>& run) {
  std::vector<Finding> findings;
  for (const auto& path : ledger.studies) {
    const Study study = read_study(path);
    std::vector<std::size_t> family(ledger.claims.size(), 0);
    for (std::size_t c = 0; c < ledger.claims.size(); ++c)
      for (const auto& cell : study.cells) family[c] += concerns(ledger.claims[c], path, cell);
    std::vector<Done> done;
    for (const auto& cell : study.cells) {
      const auto wanted = [&](const Claim& claim) {
        return concerns(claim, path, cell) || (claim.study == path && claim.than_cell == cell.name);
      };
      if (std::none_of(ledger.claims.begin(), ledger.claims.end(), wanted)) continue;
      auto reduced = with_named_methods(ledger, path, cell);
      auto result = run(study, reduced);
      done.push_back({std::move(reduced), std::move(result)});
    }
    for (std::size_t c = 0; c < ledger.claims.size(); ++c) {
      const Claim& claim = ledger.claims[c];
      for (const auto& own : done) {
        if (!concerns(claim, path, own.cell)) continue;
        const auto other = std::find_if(done.begin(), done.end(), [&](const Done& d) {
          return d.cell.name == claim.than_cell;
        });
        findings.push_back(judge_one(claim, own, other == done.end() ? own : *other, family[c]));
        findings.back().claim = c;
      }
    }
  }
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.claim < b.claim; });
  return findings;
}

std::vector<Table> ledger_tables(const Ledger& ledger, const std::vector<Finding>& findings) {
  Table claims{
      .title = ledger.title,
      .columns = {
          {"claim", ""}, {"source", ""}, {"measured", ""}, {"difference", ""}, {"verdict", ""}}};
  Table detail{.title = ledger.title + ": findings",
               .columns = {{"claim", ""},
                           {"cell", ""},
                           {"mean", ""},
                           {"± 95 %", ""},
                           {"difference", ""},
                           {"from", ""},
                           {"to", ""},
                           {"trials", ""},
                           {"verdict", ""},
                           {"trials to tell", ""}}};
  for (std::size_t c = 0; c < ledger.claims.size(); ++c) {
    std::vector<const Finding*> own;
    for (const auto& f : findings) {
      if (f.claim != c) continue;
      own.push_back(&f);
      detail.rows.push_back(
          {ledger.claims[c].text, f.cell, cell(f.mean), cell(f.mean_half_width), cell(f.quantity),
           cell(f.low), cell(f.high), static_cast<std::int64_t>(f.trials),
           std::string(name_of(f.verdict)),
           f.verdict == Verdict::not_separable ? cell(f.trials_needed) : TableCell()});
    }
    claims.rows.push_back({ledger.claims[c].text, ledger.claims[c].source,
                           statement(ledger.claims[c]), differences_of(own), summary_of(own)});
  }
  detail.notes.push_back(
      "mean: of the claim's metric over trials, in its unit; difference: that minus "
      "what it is claimed to lie below or above, paired by trial, with its 95 % interval from, to, "
      "simultaneous over the claim's cells (Bonferroni)");
  return {claims, detail};
}

}  // namespace gyrostat
