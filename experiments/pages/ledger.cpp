#include <gyrostat/experiments/pages/ledger.hpp>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {

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
    claim.of = entry.text("of", "");
    claim.not_judged = entry.text("not_judged", "");
    if (!claim.not_judged.empty()) {
      entry.finish();
      ledger.claims.push_back(claim);
      continue;
    }
    claim.study = (folder / entry.text("study", "")).lexically_normal().string();
    claim.method = entry.text("method", "");
    claim.than = entry.text("than", "");
    claim.than_cell = entry.text("than_cell", "");
    claim.value = entry.number("value", 0.0, ranges::any, "");
    for (const auto& [tau, tau_place] : entry.list("allan_tau_s"))
      claim.allan_tau_s.push_back(
          JsonObject::checked_number(*tau, tau_place, ranges::positive, "s"));
    if (claim.allan_tau_s.empty())
      claim.metric = metric_named(entry.text("metric", ""), entry.place_of("metric"));
    else
      claim.allan_trials =
          static_cast<std::uint32_t>(entry.number("allan_trials", 100, ranges::count, "trials"));
    claim.exponential_per_dps2 =
        entry.number("exponential_per_dps2", 0.0, ranges::non_negative, "1/dps²");
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

}  // namespace gyrostat
