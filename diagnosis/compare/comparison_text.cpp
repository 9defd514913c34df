#include <gyrostat/diagnosis/compare/comparison_text.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/words.hpp>
#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/diagnosis/physical.hpp>

namespace gyrostat::gap {
namespace {

std::string sizes(const Difference& d) {
  if (d.effect == white_noise)
    return fmt::format("{:.4g} dps a sample, in the recording {:.4g}", d.simulated_std, d.real_std);
  if (d.effect == random_walk)
    return fmt::format("{:.4g} dps/√s, in the recording {:.4g}", d.simulated_std, d.real_std);
  const auto all = [](const std::vector<Effect>& effects) {
    std::vector<std::string> words;
    for (const auto& effect : effects) words.push_back(parameters_in_words(effect));
    return fmt::format("{}", fmt::join(words, "; "));
  };
  if (d.real.empty()) return "in the simulator " + all(d.simulated);
  if (d.simulated.empty()) return "in the recording " + all(d.real);
  return fmt::format("{}, in the recording {}", all(d.simulated), all(d.real));
}

std::string title_of(const std::string& effect) {
  if (effect == white_noise) return "white noise";
  if (effect == random_walk) return "a random walk of the bias";
  return fmt::format("{} ({})", effect, effect_types().named(effect, "effects").title);
}

std::string said(const Difference& d) {
  switch (d.how) {
    case Differs::lacks:
      return "lacks " + title_of(d.effect);
    case Differs::too_little:
      return "has too little of " + title_of(d.effect);
    case Differs::too_much:
      return "has too much of " + title_of(d.effect);
    case Differs::other_form:
      return "has another form of " + title_of(d.effect);
  }
  return "";
}

std::string differences_in_words(const Comparison& c) {
  std::vector<std::string> words;
  for (const auto& d : c.differences) words.push_back(said(d));
  if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
  return fmt::format("{} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

std::string closing(const Comparison& c) {
  if (c.addition.is_nothing()) return " Nothing can be added to its traces that would mend that.";
  if (c.gap_before == 0.0) return " The readings of the rate show no gap to close.";
  return fmt::format(
      " With what it lacks added, its traces come {:.0f} % closer to the parts of the recording "
      "that were held back (95 %: {:.0f} to {:.0f}).",
      100.0 * c.closed, 100.0 * c.closed_low, 100.0 * c.closed_high);
}

std::string power_in_words(const Comparison& c) {
  constexpr double enough = 0.8;
  for (const auto& p : c.power)
    if (p.power >= enough)
      return fmt::format(
          "So many traces would show noise that is {:.0f} % larger in {:.0f} % of "
          "cases.",
          100.0 * p.louder, 100.0 * p.power);
  return "So few and short traces would hardly show noise that is half as large again.";
}

}  // namespace

std::string in_words(const Comparison& c, const std::string& recordings,
                     const std::string& simulated) {
  std::string text = fmt::format("{} against {}: ", simulated, recordings);
  if (c.verdict.is_none())
    text += "The simulator makes such recordings: no difference is seen.";
  else if (c.verdict.is_unknown() && c.differences.empty())
    text +=
        "The simulator differs from the recording in something that no effect of the catalogue "
        "explains.";
  else if (c.verdict.is_unknown())
    text += fmt::format(
        "The simulator differs from the recording in more than the catalogue "
        "explains. Nearest: it {}.{}",
        differences_in_words(c), closing(c));
  else
    text += fmt::format("The simulator {}.{}", differences_in_words(c), closing(c));
  text += fmt::format(
      "\n\np {} that segments of both are alike ({} and {} of {:.4g} s, "
      "relabelled){}. Gap on what was held back: {:.3g}{} spreads of a segment. {}\n",
      chance_in_words(c.p_before), c.segments_real, c.segments_simulated, c.segment_s,
      c.addition.is_nothing() ? "" : fmt::format(", {} once added", chance_in_words(c.p_after)),
      c.gap_before, c.addition.is_nothing() ? "" : fmt::format(" to {:.3g}", c.gap_after),
      power_in_words(c));
  return text;
}

std::vector<Table> comparison_tables(const Comparison& c) {
  Table differences{.title = "where the simulator differs",
                    .columns = {{"effect", ""},
                                {"simulator", ""},
                                {"log odds", "nat"},
                                {"p", "1"},
                                {"gap after", "spreads"},
                                {"closed", "1"}}};
  for (const auto& d : c.differences) {
    differences.rows.push_back(
        {d.effect, std::string(name_of(d.how)), d.log_odds, d.p, d.gap_after, d.closed});
    differences.notes.push_back(fmt::format("{}: {}", d.effect, sizes(d)));
  }
  if (c.differences.empty()) differences.notes.emplace_back("nowhere");
  for (const auto& u : c.undecided)
    differences.notes.push_back(fmt::format("undecided: {}: {}", u.effect, u.why));
  Table steps{.title = "the gap on the held-out parts, step by step",
              .columns = {{"added", ""}, {"gap", "spreads"}}};
  for (const auto& e : c.enrichments)
    steps.rows.push_back({e.added.empty() ? "(the traces as they are)" : e.added, e.gap});
  Table where{.title = "where segments differ",
              .columns = {{"lens", ""},
                          {"coordinate", ""},
                          {"from", ""},
                          {"to", ""},
                          {"recording", ""},
                          {"simulator", ""},
                          {"unit", ""},
                          {"p", "1"}}};
  for (const auto& w : c.where) {
    const Physical value(w.unit);
    where.rows.push_back({w.lens, w.coordinate, w.from, w.to, value(w.observed), value(w.simulated),
                          value.unit, w.p_adjusted});
  }
  if (c.where.empty()) where.notes.emplace_back("nowhere");
  Table missing{.title = "not assessable", .columns = {{"effect", ""}, {"why", ""}}};
  for (const auto& n : c.not_assessable) missing.rows.push_back({n.effect, n.why});
  return {differences, steps, where, missing};
}

nlohmann::ordered_json to_json(const Comparison& c) {
  using J = nlohmann::ordered_json;
  const auto all = [](const std::vector<Effect>& effects) {
    J list = J::array();
    for (const auto& effect : effects) list.push_back(parameters_json(effect));
    return list;
  };
  J json;
  json["recording"] = {{"traces", c.real_traces},
                       {"rate_hz", c.rate_hz},
                       {"segments", c.segments_real},
                       {"effects", c.in_recording}};
  json["simulator"] = {{"traces", c.simulated_traces},
                       {"segments", c.segments_simulated},
                       {"segment_s", c.segment_s},
                       {"effects", c.in_simulator},
                       {"power", J::array()}};
  for (const auto& p : c.power)
    json["simulator"]["power"].push_back({{"noise_larger_by", p.louder}, {"power", p.power}});
  json["where"] = departures_json(c.where);
  json["gap"] = {
      {"before", c.gap_before}, {"after", c.gap_after},
      {"closed", c.closed},     {"closed_interval", J::array({c.closed_low, c.closed_high})},
      {"p_before", c.p_before}, {"p_after", c.p_after}};
  json["effects"] = J::array();
  for (const auto& d : c.differences) {
    J entry = {{"effect", d.effect},        {"simulator", name_of(d.how)},
               {"log_odds", d.log_odds},    {"p", d.p},
               {"gap_after", d.gap_after},  {"closed", d.closed},
               {"parameters", all(d.real)}, {"simulated", all(d.simulated)}};
    if (d.effect == white_noise || d.effect == random_walk) {
      const char* unit = d.effect == white_noise ? "std_dps" : "dps_per_sqrt_s";
      entry["parameters"] = J::array({{{unit, d.real_std}}});
      entry["simulated"] = J::array({{{unit, d.simulated_std}}});
    }
    json["effects"].push_back(entry);
  }
  json["undecided"] = J::array();
  for (const auto& u : c.undecided)
    json["undecided"].push_back({{"effect", u.effect}, {"why", u.why}});
  json["verdict"] = c.verdict.text();
  json["verdict_set"] = J::array();
  for (const auto& verdict : c.verdict_set) json["verdict_set"].push_back(verdict.text());
  json["steps"] = J::array();
  for (const auto& e : c.enrichments) json["steps"].push_back({{"added", e.added}, {"gap", e.gap}});
  json["not_assessable"] = J::array();
  for (const auto& n : c.not_assessable)
    json["not_assessable"].push_back({{"effect", n.effect}, {"why", n.why}});
  return json;
}

}  // namespace gyrostat::gap
