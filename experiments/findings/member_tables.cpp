#include <gyrostat/experiments/findings/member_tables.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {
namespace {

std::string effects_of(const Diagnosis& d) {
  std::vector<std::string> names;
  for (const auto& e : d.effects) names.push_back(e.effect);
  return names.empty() ? d.verdict.text() : fmt::format("{}", fmt::join(names, ", "));
}

/// "noise_bandwidth (poles 2)": what is 0 of a form is not there.
std::string called(const SharedEffect& shared) {
  const auto& described = effect_types().named(shared.effect, "effects");
  std::vector<std::string> form;
  for (const auto& p : shared.parameters)
    for (const auto& field : described.fields)
      if (field.name == p.name && field.range.whole && p.mean != 0.0)
        form.push_back(fmt::format("{} {:g}", p.name, p.mean));
  return form.empty() ? shared.effect
                      : fmt::format("{} ({})", shared.effect, fmt::join(form, ", "));
}

/// Whether a parameter tells more than that another form is not there.
bool tells(const SharedEffect& shared, const SharedParameter& p) {
  const auto& described = effect_types().named(shared.effect, "effects");
  const auto field = std::find_if(described.fields.begin(), described.fields.end(),
                                  [&](const auto& f) { return f.name == p.name; });
  return !field->range.whole && (p.mean != 0.0 || p.spread != 0.0);
}

}  // namespace

std::vector<Table> member_tables(const std::vector<FleetMember>& members, const std::string& kind) {
  Table each{.title = "each " + kind,
             .columns = {{kind, ""},
                         {"verdict", ""},
                         {"effects", ""},
                         {"p as it stands", "1"},
                         {"gap", "spreads"},
                         {"closed", "1"},
                         {"with nameless", "1"}}};
  for (const auto& m : members) {
    const auto& d = m.diagnosis;
    each.rows.push_back({m.name, d.verdict.text(), effects_of(d), d.p_before, d.gap_before,
                         d.closed, d.remainder.parts.empty() ? d.closed : d.remainder.closed});
  }
  Table shared{.title = "what they share",
               .columns = {{"effect", ""},
                           {"in", ""},
                           {"parameter", ""},
                           {"mean", ""},
                           {"95 %", ""},
                           {"spread", ""},
                           {"95 % of it", ""},
                           {"p, equal", "1"}}};
  const auto range = [](double low, double high) {
    return is_missing(low) ? std::string() : fmt::format("{:.4g} to {:.4g}", low, high);
  };
  const auto sampled = std::ranges::count(members, std::size_t{1}, &FleetMember::mean_of);
  for (const auto& s : shared_effects(members))
    for (const auto& p : s.parameters)
      if (tells(s, p))
        shared.rows.push_back(
            {called(s), fmt::format("{} of {}", s.members.size(), sampled), p.name, cell(p.mean),
             range(p.mean_low, p.mean_high),
             s.fitted_once && p.spread == 0.0 ? TableCell("fitted once") : cell(p.spread),
             range(p.spread_low, p.spread_high), cell(p.p_equal)});
  return {each, shared};
}

}  // namespace gyrostat::gap
