#include <gyrostat/experiments/findings/failure_ranking.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/proportion.hpp>

namespace gyrostat {
namespace {

bool is_told(const RankedFailure& failure) { return !std::isnan(failure.probability); }

std::string sentence(const RankedFailure& better, const RankedFailure& worse,
                     const FailureRatio* ratio) {
  if (ratio == nullptr) {
    if (!is_told(worse))
      return is_told(better) && worse.high < 1.0
                 ? fmt::format("{} is not told apart from {}: more \"levels\" may tell",
                               worse.method, better.method)
                 : "";
    return worse.low > better.high
               ? fmt::format("{} fails less often than {}: below {:.3g}", better.method,
                             worse.method, better.high)
               : fmt::format("{} is not told apart from {}: more \"levels\" may tell",
                             better.method, worse.method);
  }
  const double times = worse.probability / better.probability;
  return ratio->separable()
             ? fmt::format("{} fails {:.3g} times ({:.3g} to {:.3g}) as often as {}", worse.method,
                           times, ratio->low, ratio->high, better.method)
             : fmt::format("{} and {} are not separable ({:.3g} times as often, {:.3g} to {:.3g})",
                           better.method, worse.method, times, ratio->low, ratio->high);
}

}  // namespace

std::vector<RankedFailure> rank_failures(const std::vector<FailureFinding>& findings) {
  std::vector<RankedFailure> ranking;
  for (const auto& f : findings) {
    auto& ranked = ranking.emplace_back(RankedFailure{.method = f.method});
    if (f.rare) {
      ranked = {f.method, f.rare->probability, f.rare->low, f.rare->high};
    } else if (f.plain.is_enough()) {
      const auto [low, high] = wilson_interval(f.plain.failing, f.plain.trials, 0.95);
      ranked = {f.method, static_cast<double>(f.plain.failing) / f.plain.trials, low, high};
    } else if (f.rarer_than) {
      ranked.high = *f.rarer_than;
    }
  }
  const auto place = [](const RankedFailure& f) {
    return is_told(f) ? f.probability : f.high < 1.0 ? f.high : 2.0;
  };
  std::stable_sort(ranking.begin(), ranking.end(),
                   [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return ranking;
}

std::vector<FailureRatio> failure_ratios(const std::vector<RankedFailure>& ranking) {
  const auto n = static_cast<double>(ranking.size());
  const double pairs = std::max(1.0, n * (n - 1.0) / 2.0);
  const double wider = normal_upper_quantile(0.025 / pairs) / normal_upper_quantile(0.025);
  std::vector<FailureRatio> ratios;
  for (std::size_t i = 0; i + 1 < ranking.size(); ++i) {
    const auto &a = ranking[i], &b = ranking[i + 1];
    if (!is_told(a) || !is_told(b)) continue;
    const double ratio = std::log(b.probability / a.probability);
    const double below =
        std::hypot(std::log(b.probability / b.low), std::log(a.high / a.probability));
    const double above =
        std::hypot(std::log(b.high / b.probability), std::log(a.probability / a.low));
    ratios.push_back({i, i + 1, std::exp(ratio - wider * below), std::exp(ratio + wider * above)});
  }
  return ratios;
}

Table failure_ranking_table(const Cell& cell, const std::vector<FailureFinding>& findings) {
  const auto& rule = *cell.failure;
  const auto& metric = metric_types()[rule.metric];
  const auto ranking = rank_failures(findings);
  const auto ratios = failure_ratios(ranking);
  Table table{
      .title = fmt::format("{}: ranking by how likely is {} {} {:g} {}", cell.name, metric.id,
                           rule.above ? "above" : "below", rule.threshold, metric.unit),
      .columns = {{"method", ""}, {"probability", ""}, {"2.5 %", ""}, {"97.5 %", ""}}};
  for (const auto& f : ranking)
    table.rows.push_back({f.method, gyrostat::cell(f.probability),
                          is_told(f) ? TableCell(f.low) : TableCell(),
                          is_told(f) || f.high < 1.0 ? TableCell(f.high) : TableCell()});
  for (std::size_t i = 0; i + 1 < ranking.size(); ++i) {
    const auto ratio = std::find_if(ratios.begin(), ratios.end(),
                                    [&](const FailureRatio& r) { return r.better == i; });
    const auto text =
        sentence(ranking[i], ranking[i + 1], ratio == ratios.end() ? nullptr : &*ratio);
    if (!text.empty()) table.notes.push_back(text);
  }
  for (const auto& f : ranking)
    if (!is_told(f) && f.high == 1.0)
      table.notes.push_back(f.method + " is not told: gyrostat failure says how far it is");
  if (ranking.size() > 2 && !ratios.empty())
    table.notes.push_back("intervals of ratios hold for all pairs together");
  return table;
}

}  // namespace gyrostat
