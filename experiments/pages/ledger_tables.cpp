#include <gyrostat/experiments/pages/ledger.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/results/render/interval.hpp>

namespace gyrostat {
namespace {

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
  auto metric = claim.allan_tau_s.empty() ? metric_types()[claim.metric].id : "Allan deviation";
  if (claim.exponential_per_dps2 > 0.0)
    metric = fmt::format("mean exp({:g} {}²)", claim.exponential_per_dps2, metric);
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
  const std::string everywhere = findings.size() == 1
                                     ? " in this scenario"
                                     : fmt::format(" in these {} scenarios", findings.size());
  for (const auto verdict :
       {Verdict::holds, Verdict::does_not_hold, Verdict::not_separable, Verdict::equal})
    if (all(verdict)) return name_of(verdict) + everywhere;
  if (where.empty()) return "does not hold, or not separable," + everywhere;
  if (elsewhere.size() < where.size())
    return fmt::format("holds in {} of {}, not in {}", where.size(), findings.size(),
                       fmt::join(elsewhere, ", "));
  return fmt::format("holds only in {}", fmt::join(where, ", "));
}

/// How far a finding is on the claim's side: by its verdict first, then relative to what it is
/// compared with.
std::pair<int, double> favour(const Claim& claim, const Finding& f) {
  const int verdict = f.verdict == Verdict::holds ? 2 : f.verdict == Verdict::does_not_hold ? 0 : 1;
  const double towards = claim.above ? f.quantity : -f.quantity;
  const double size = std::abs(f.rival_mean);
  return {verdict, size > 0.0 ? towards / size : towards};
}

/// The finding most in favour of claim `c` among all its readings, in words.
std::string most_favourable(const Ledger& ledger, const std::vector<Finding>& findings,
                            std::size_t c) {
  const auto is_reading = [&](std::size_t other) {
    return other == c ||
           (!ledger.claims[c].of.empty() && ledger.claims[other].of == ledger.claims[c].of);
  };
  const Finding* best = nullptr;
  for (const auto& f : findings) {
    if (!is_reading(f.claim) || std::isnan(f.quantity)) continue;
    if (best == nullptr ||
        favour(ledger.claims[best->claim], *best) < favour(ledger.claims[f.claim], f))
      best = &f;
  }
  if (best == nullptr) return "";
  const auto ratio = best->rival_mean != 0.0 && !ledger.claims[best->claim].than.empty()
                         ? fmt::format(", {:.3g} of it", best->mean / best->rival_mean)
                         : std::string();
  return fmt::format("{} in {}: {}{}", statement(ledger.claims[best->claim]), best->cell,
                     name_of(best->verdict), ratio);
}

bool holds_throughout(const std::vector<const Finding*>& findings) {
  return std::all_of(findings.begin(), findings.end(),
                     [](const Finding* f) { return f->verdict == Verdict::holds; });
}

}  // namespace

std::vector<Table> ledger_tables(const Ledger& ledger, const std::vector<Finding>& findings) {
  Table claims{.title = ledger.title,
               .columns = {{"claim", ""},
                           {"source", ""},
                           {"measured", ""},
                           {"difference", ""},
                           {"verdict", ""},
                           {"most favourable reading tried", ""}}};
  Table detail{.title = ledger.title + ": findings",
               .columns = {{"claim", ""},
                           {"cell", ""},
                           {"mean", ""},
                           {"± 95 %", ""},
                           {"difference", ""},
                           {"from", ""},
                           {"to", ""},
                           {"ratio", ""},
                           {"trials", ""},
                           {"verdict", ""},
                           {"trials to tell", ""}}};
  for (std::size_t c = 0; c < ledger.claims.size(); ++c) {
    if (!ledger.claims[c].not_judged.empty()) {
      claims.rows.push_back({ledger.claims[c].text, ledger.claims[c].source, TableCell(),
                             TableCell(), "not judged: " + ledger.claims[c].not_judged,
                             TableCell()});
      continue;
    }
    std::vector<const Finding*> own;
    for (const auto& f : findings) {
      if (f.claim != c) continue;
      own.push_back(&f);
      detail.rows.push_back(
          {ledger.claims[c].text, f.cell, cell(f.mean), cell(f.mean_half_width), cell(f.quantity),
           cell(f.low), cell(f.high), cell(f.mean / f.rival_mean),
           static_cast<std::int64_t>(f.trials), std::string(name_of(f.verdict)),
           f.verdict == Verdict::not_separable ? cell(f.trials_needed) : TableCell()});
    }
    claims.rows.push_back({ledger.claims[c].text, ledger.claims[c].source,
                           statement(ledger.claims[c]), differences_of(own), summary_of(own),
                           own.empty() || holds_throughout(own)
                               ? TableCell()
                               : TableCell(most_favourable(ledger, findings, c))});
  }
  detail.notes.push_back(
      "mean: of the claim's metric over trials, in its unit; ratio: to what it is compared with; "
      "difference: that minus "
      "what it is claimed to lie below or above, paired by trial, with its 95 % interval from, to, "
      "simultaneous over the claim's cells (Bonferroni)");
  return {claims, detail};
}

}  // namespace gyrostat
