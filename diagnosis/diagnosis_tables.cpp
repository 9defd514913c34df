#include <gyrostat/diagnosis/diagnosis_tables.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gyrostat::gap {
namespace {

std::string parameters_in_words(const Effect& effect) {
  std::string words;
  for (std::size_t i = 0; i < effect.fields().size(); ++i) {
    const auto& field = effect.fields()[i];
    words += fmt::format("{}{} = {:.4g} {}", words.empty() ? "" : ", ", field.name, effect.value(i),
                         field.unit == "1" ? "" : field.unit);
  }
  return words;
}

std::string others_of(const Diagnosis& d) {
  std::vector<std::string> others;
  const auto is_found = [&](const Verdict& verdict) {
    return std::any_of(d.effects.begin(), d.effects.end(),
                       [&](const auto& e) { return verdict.names(e.effect); });
  };
  for (const auto& verdict : d.verdict_set)
    if (verdict != d.verdict && !is_found(verdict)) others.push_back(verdict.text());
  return fmt::format("{}", fmt::join(others, ", "));
}

std::string claimed_effects(const Diagnosis& d) {
  std::vector<std::string> effects;
  for (const auto& verdict : d.verdict_set) effects.push_back(verdict.text());
  return fmt::format("{}", fmt::join(effects, ", then "));
}

}  // namespace

std::string in_words(const Diagnosis& d, const std::string& name) {
  std::string text = fmt::format("{}: {:.0f} s at {:.4g} Hz. ", name, d.duration_s, d.rate_hz);
  if (d.verdict.is_none())
    return text +
           fmt::format("No gap: the simulator makes recordings like this one (p = {:.2g}).\n",
                       d.p_before);
  if (d.verdict.is_unknown()) {
    text += fmt::format(
        "The recording leaves the simulator (p = {:.2g}), and no effect of the catalogue explains "
        "it.",
        d.p_before);
    if (!d.effects.empty())
      text += fmt::format(" The nearest is {}: the set recovers {:.0f} % of what a true one would.",
                          d.effects.front().effect, 100.0 * d.recovered);
    return text + '\n';
  }
  const auto gap = fmt::format(
      " On the held-out part the gap goes from {:.3g} to {:.3g}: {:.0f} % closed (95 %: {:.0f} to "
      "{:.0f} %).",
      d.gap_before, d.gap_after, 100.0 * d.closed, 100.0 * d.closed_low, 100.0 * d.closed_high);
  if (d.claimed) return text + fmt::format("Claimed: {}.{}\n", claimed_effects(d), gap);
  const auto& cause = d.causes.front();
  text += fmt::format(
      "The recording leaves the simulator (p = {:.2g}). Cause: {} ({}; probability {:.2f}).",
      d.p_before, cause.effect, parameters_in_words(cause.scenario.effects.back()),
      cause.probability);
  for (std::size_t k = 1; k < d.effects.size(); ++k)
    text += fmt::format("{} {} ({:.2f})", k == 1 ? " With it:" : ",", d.effects[k].effect,
                        d.effects[k].inclusion);
  if (d.effects.size() > 1) text += '.';
  if (const auto others = others_of(d); !others.empty())
    text += fmt::format(" This recording cannot rule out: {}.", others);
  text += gap;
  if (!d.next.what.empty())
    text += fmt::format(" To tell {} from {}: {} (right in {:.0f} % of simulated recordings).",
                        d.next.first, d.next.second, d.next.what, 100.0 * d.next.expected_power);
  return text + '\n';
}

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
  for (const auto& w : d.where)
    where.rows.push_back(
        {w.lens, w.coordinate, w.from, w.to, w.observed, w.simulated, w.unit, w.p_adjusted});
  if (d.where.empty()) where.notes.push_back("nowhere");
  Table causes{.title = name + ": causes",
               .columns = {{"effect", ""},
                           {"probability", "1"},
                           {"log score gained", "nat"},
                           {"recovered", "1"},
                           {"gap after", "spreads"},
                           {"closed", "1"},
                           {"parameters", ""}}};
  for (const auto& c : d.causes)
    causes.rows.push_back({c.effect, c.probability, c.log_score, c.recovered, c.gap_after, c.closed,
                           parameters_in_words(c.scenario.effects.back())});
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
                             {"simulated after", ""}}};
  for (const auto& t : d.transfer)
    promises.rows.push_back(
        {t.filter, t.metric, t.unit, cell(t.real), cell(t.before), cell(t.after)});
  Table missing{.title = name + ": not assessable", .columns = {{"effect", ""}, {"why", ""}}};
  for (const auto& n : d.not_assessable) missing.rows.push_back({n.effect, n.why});
  return {where, causes, steps, promises, missing};
}

}  // namespace gyrostat::gap
