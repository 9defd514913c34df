#include <gyrostat/experiments/pages/ledger.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/paired.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/pages/played.hpp>

namespace gyrostat {
namespace {

std::vector<double> values_for(const Claim& claim, const CellResult& result, std::size_t method) {
  auto values = metric_values(result, method, claim.metric);
  if (claim.absolute)
    for (double& v : values) v = std::abs(v);
  if (claim.exponential_per_dps2 > 0.0)
    for (double& v : values) v = std::exp(claim.exponential_per_dps2 * v * v);
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

Finding decided(const Claim& claim, const std::string& place, const std::vector<double>& values,
                const std::vector<double>& against, std::size_t family) {
  const auto d = paired_difference(values, against, family);
  const auto own = summarise(values);
  Finding finding{.cell = place,
                  .mean = own.mean,
                  .mean_half_width = own.half_width_95,
                  .quantity = d.mean,
                  .rival_mean = summarise(against).mean,
                  .low = d.low,
                  .high = d.high,
                  .trials_needed = d.trials_needed,
                  .trials = d.count};
  const double towards = claim.above ? d.mean : -d.mean;
  if (d.low == 0.0 && d.high == 0.0) finding.verdict = Verdict::equal;
  if (d.separable) finding.verdict = towards > 0.0 ? Verdict::holds : Verdict::does_not_hold;
  return finding;
}

Finding judge_metric(const Claim& claim, const Done& done, const Done& other, std::size_t family) {
  const auto values = values_for(claim, done.result, method_index(done.cell, claim.method));
  const auto& rival = claim.than.empty() ? claim.method : claim.than;
  const auto against = claim.than.empty() && claim.than_cell.empty()
                           ? std::vector<double>(values.size(), claim.value)
                           : values_for(claim, other.result, method_index(other.cell, rival));
  return decided(claim, done.cell.name, values, against, family);
}

/// One finding a tau, over the cell's first trials; those that were not run are left out.
std::vector<Finding> judge_allan(const Claim& claim, const Done& done, std::uint64_t seed,
                                 std::size_t family) {
  const std::size_t taus = claim.allan_tau_s.size();
  std::vector<std::vector<double>> ours(taus), theirs(taus);
  std::vector<std::size_t> methods = {method_index(done.cell, claim.method)};
  if (!claim.than.empty()) methods.push_back(method_index(done.cell, claim.than));
  for (std::uint32_t trial = 0; trial < done.result.trials.size(); ++trial) {
    if (trial >= claim.allan_trials) break;
    if (!done.result.trials[trial]) continue;
    const auto found =
        allan_deviations(play(done.cell, done.result, seed, trial, methods), claim.allan_tau_s);
    for (std::size_t t = 0; t < taus; ++t) {
      ours[t].push_back(found.front()[t]);
      theirs[t].push_back(claim.than.empty() ? claim.value : found.back()[t]);
    }
  }
  std::vector<Finding> findings;
  for (std::size_t t = 0; t < taus; ++t)
    findings.push_back(decided(claim,
                               fmt::format("{} at {:g} s", done.cell.name, claim.allan_tau_s[t]),
                               ours[t], theirs[t], family));
  return findings;
}

/// No signal tells an Allan deviation at less than a sample or at more than half of its length.
void require_taus(const Claim& claim, const Cell& cell) {
  const auto& sampling = cell.scenario.sampling;
  const Range told{.from = 1.0 / sampling.rate_hz, .to = sampling.duration_s / 2};
  for (const double tau_s : claim.allan_tau_s)
    if (tau_s < told.from * (1.0 - 1e-9) || tau_s > told.to * (1.0 + 1e-9))
      throw InputError(fmt::format("\"{}\": allan_tau_s", claim.text),
                       fmt::format("{:g} s is out of range; allowed of cell {}: {}", tau_s,
                                   cell.name, values_in_words(told, "s")));
}

}  // namespace

std::vector<Finding> judge(const Ledger& ledger,
                           const std::function<CellResult(const Study&, const Cell&)>& run) {
  std::vector<Finding> findings;
  for (const auto& path : ledger.studies) {
    const Study study = read_study(path);
    std::vector<std::size_t> family(ledger.claims.size(), 0);
    for (std::size_t c = 0; c < ledger.claims.size(); ++c)
      for (const auto& cell : study.cells)
        family[c] += concerns(ledger.claims[c], path, cell) *
                     std::max<std::size_t>(1, ledger.claims[c].allan_tau_s.size());
    for (const auto& claim : ledger.claims)
      for (const auto& cell : study.cells)
        if (concerns(claim, path, cell)) require_taus(claim, cell);
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
        auto found = claim.allan_tau_s.empty()
                         ? std::vector{judge_metric(claim, own, other == done.end() ? own : *other,
                                                    family[c])}
                         : judge_allan(claim, own, study.seed, family[c]);
        for (auto& finding : found) {
          finding.claim = c;
          findings.push_back(std::move(finding));
        }
      }
    }
  }
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.claim < b.claim; });
  return findings;
}

}  // namespace gyrostat
