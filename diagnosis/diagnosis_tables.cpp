#include <gyrostat/diagnosis/diagnosis_tables.hpp>

#include <fmt/format.h>

#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/physical.hpp>

namespace gyrostat::gap {
std::string in_words(const Diagnosis& d, const std::string& name) {
  auto text = fmt::format("{}: {}", name, answer(d));
  for (const auto& more : {in_words(d.line_sources), transient_in_words(d), remainder_in_words(d),
                           transfer_in_words(d), next_in_words(d), detectable_in_words(d)})
    if (!more.empty()) text += ' ' + more;
  return text + fmt::format("\n\n{:.0f} s at {:.4g} Hz. {}\n", d.duration_s, d.rate_hz,
                            evidence_in_words(d));
}

namespace {

Table detectable_table(const Diagnosis& d, const std::string& name) {
  Table table{.title = fmt::format("{}: what would have been found with {:.0f} %", name,
                                   100.0 * Detectable::power),
              .columns = {{"effect", ""}, {"size", ""}, {"unit", ""}, {"otherwise", ""}}};
  for (const auto& seen : d.detectable)
    table.rows.push_back({std::string(seen.effect.id()), seen.effect.value(seen.field),
                          std::string(seen.effect.fields()[seen.field].unit),
                          parameters_in_words(seen.effect, seen.field)});
  if (!d.detectable.empty())
    table.notes.push_back("of an effect that is not there, beside what is");
  return table;
}

}  // namespace

std::vector<Table> diagnosis_tables(const Diagnosis& d, const std::string& name) {
  Table where{.title = name + ": where the recording leaves the simulator",
              .columns = {{"lens", ""},
                          {"coordinate", ""},
                          {"from", ""},
                          {"to", ""},
                          {"observed", ""},
                          {"simulated", ""},
                          {"unit", ""},
                          {"p, family-wise", "1"}}};
  for (const auto& w : d.where) {
    const Physical value(w.unit);
    where.rows.push_back({w.lens, w.coordinate, w.from,
                          w.to < Interval::no_end ? TableCell(w.to) : TableCell(),
                          value(w.observed), value(w.simulated), value.unit, w.p_adjusted});
  }
  if (d.where.empty()) where.notes.push_back("nowhere");
  Table causes{.title = name + ": causes",
               .columns = {{"effect", ""},
                           {"posterior probability", "1"},
                           {"log score gained", "nat"},
                           {"recovered", "1"},
                           {"gap after", "spreads"},
                           {"closed", "1"},
                           {"parameters", ""}}};
  for (const auto& c : d.causes) {
    std::vector<std::string> parameters;  // several where it is there several times
    for (const auto& effect : c.scenario.effects)
      if (effect.id() == c.effect) parameters.push_back(parameters_in_words(effect));
    causes.rows.push_back({c.effect, c.probability, c.log_score, c.recovered, c.gap_after, c.closed,
                           fmt::format("{}", fmt::join(parameters, "; "))});
  }
  if (!d.causes.empty() && !d.claimed)
    causes.notes.push_back(
        "posterior probability: of being what the recording has and the simulator lacks; the "
        "inclusion probability of an effect, times what its set recovers where something is left");
  Table steps{.title = name + ": the gap on the held-out part, step by step",
              .columns = {{"added", ""}, {"gap", "spreads"}}};
  for (const auto& e : d.enrichments)
    steps.rows.push_back({e.added.empty() ? "(baseline)" : e.added, e.gap});
  Table promises{.title = name + ": what the study promises, and what the recording shows",
                 .columns = {{"filter", ""},
                             {"metric", ""},
                             {"unit", ""},
                             {"recording", ""},
                             {"simulated before", ""},
                             {"simulated after", ""},
                             {"moved", ""}}};
  for (const auto& t : d.transfer)
    promises.rows.push_back({t.filter, t.metric, t.unit, cell(t.real), cell(t.before),
                             cell(t.after),
                             d.enrichments.size() < 2 ? "" : std::string(name_of(t.moved))});
  Table missing{.title = name + ": not assessable", .columns = {{"effect", ""}, {"why", ""}}};
  for (const auto& n : d.not_assessable) missing.rows.push_back({n.effect, n.why});
  std::vector<Table> all{causes, steps, promises, where, missing, detectable_table(d, name)};
  std::erase_if(all, [](const Table& table) { return table.rows.empty() && table.notes.empty(); });
  return all;
}

}  // namespace gyrostat::gap
