#include <gyrostat/experiments/findings/ranking.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/error_metric.hpp>
#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/all_pairs.hpp>
#include <gyrostat/analysis/statistics/mean_ranks.hpp>
#include <gyrostat/analysis/statistics/streamed.hpp>
#include <gyrostat/analysis/statistics/tail_mean.hpp>
#include <gyrostat/core/outcome.hpp>
#include <gyrostat/experiments/findings/ranking_words.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/stopping.hpp>

namespace gyrostat {
namespace {

struct RankedMetric {
  std::size_t index;
  std::string id, unit;
  bool by_size;  ///< of the value, whatever its sign
};

/// Small is good of errors and of the logarithmic score; the other metrics are no errors.
RankedMetric metric_of(const Cell& cell, const std::string& name) {
  RankedMetric metric{.index = 0,
                      .id = name.empty() ? std::string(judging_metric(cell)) : name,
                      .unit = "",
                      .by_size = false};
  metric.index = error_metric_named(metric.id, "--metric");
  metric.unit = std::string(metric_types()[metric.index].unit);
  metric.by_size = metric_types()[metric.index].goal == Goal::near_zero;
  return metric;
}

/// Everything that is learnt of a cell's trials while they pass by.
struct Streams {
  std::vector<StreamedSummary> summaries;
  std::vector<StreamedTailMean> tails;
  std::vector<bool> summary_open, tail_open;
  RankStatistics ranks;
  std::optional<AllPairs> pairs;
  std::vector<std::size_t> diverged, broken_down;
  std::size_t trials = 0;

  explicit Streams(std::size_t methods)
      : summaries(methods),
        tails(methods),
        summary_open(methods, true),
        tail_open(methods, true),
        ranks(methods),
        diverged(methods),
        broken_down(methods) {}
};

void count_failures(Streams& s, std::size_t method, const Outcome& outcome) {
  s.broken_down[method] += outcome.broke_down();
  s.diverged[method] += outcome.diverged();
}

Streams stream(const Cell& cell, const TrialSource& trials, const RankedMetric& metric) {
  const std::size_t methods = cell.methods.size();
  Streams s(methods);
  std::vector<double> values(methods);
  bool more = true;
  for (int pass = 0; more; ++pass) {
    trials([&](bool /*calibrated*/, std::span<const double> numbers) {
      const TrialOutcomes outcomes(numbers, methods);
      for (std::size_t m = 0; m < methods; ++m) {
        const double value = outcomes[m].metric(metric.index);
        values[m] = metric.by_size ? std::abs(value) : value;
        if (s.summary_open[m]) s.summaries[m].add(values[m]);
        if (s.tail_open[m]) s.tails[m].add(values[m]);
        if (pass == 0) count_failures(s, m, outcomes[m]);
      }
      if (pass == 0) {
        ++s.trials;
        s.ranks.add(values);
      } else if (pass <= 2) {
        s.pairs->add(values);
      }
    });
    more = pass < 2;
    for (std::size_t m = 0; m < methods; ++m) {
      if (s.summary_open[m]) s.summary_open[m] = s.summaries[m].another_pass();
      if (s.tail_open[m]) s.tail_open[m] = s.tails[m].another_pass();
      more = more || s.summary_open[m] || s.tail_open[m];
    }
    if (pass == 0)
      s.pairs.emplace(methods, comparisons_of_looks(cell, s.trials));
    else if (pass <= 2)
      s.pairs->another_pass();
  }
  return s;
}

/// Maximal sets of methods of which no two are separable (Bron and Kerbosch, CACM 16, 1973): only
/// what is not like the candidate with the most alike (Tomita, Tanaka and Takahashi, TCS 363, 2006)
/// need begin a set, or a hundred methods that are all alike would have as many sets to look at as
/// they have subsets.
class Groups {
 public:
  explicit Groups(const CellRanking& ranking)
      : alike_(ranking.methods.size(), std::vector<bool>(ranking.methods.size())) {
    for (const auto& pair : ranking.pairs)
      alike_[pair.better][pair.worse] = alike_[pair.worse][pair.better] =
          !pair.difference.separable;
  }

  /// Those that hold the best methods first; no more than CellRanking::most_groups, since there
  /// can be 3^(n/3).
  std::vector<std::vector<std::size_t>> all() && {
    std::vector<std::size_t> every(alike_.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    extend({}, every, {});
    for (auto& group : groups_) std::ranges::sort(group);
    std::ranges::sort(groups_);
    return std::move(groups_);
  }

 private:
  using Methods = std::vector<std::size_t>;

  Methods like(std::size_t m, const Methods& some) const {
    Methods found;
    std::ranges::copy_if(some, std::back_inserter(found), [&](auto o) { return alike_[m][o]; });
    return found;
  }

  void extend(const Methods& group, Methods candidates, Methods done) {
    if (groups_.size() == CellRanking::most_groups) return;
    if (candidates.empty()) {
      if (done.empty() && group.size() > 1) groups_.push_back(group);
      return;
    }
    std::size_t pivot = candidates.front(), most = 0;
    for (const auto& some : {candidates, done})
      for (const auto m : some)
        if (const auto count = like(m, candidates).size(); count > most) {
          most = count;
          pivot = m;
        }
    for (const auto m : Methods(candidates)) {
      if (alike_[pivot][m]) continue;
      auto larger = group;
      larger.push_back(m);
      extend(larger, like(m, candidates), like(m, done));
      std::erase(candidates, m);
      done.push_back(m);
    }
  }

  std::vector<std::vector<bool>> alike_;
  std::vector<Methods> groups_;
};

}  // namespace

CellRanking rank_cell(const Cell& cell, const TrialSource& trials, const std::string& name) {
  const auto metric = metric_of(cell, name);
  const auto s = stream(cell, trials, metric);
  CellRanking ranking{.cell = cell.name,
                      .metric = metric.id,
                      .unit = metric.unit,
                      .trials = s.trials,
                      .methods = {},
                      .not_separable = {},
                      .sentences = {},
                      .pairs = {}};
  const auto mean = [&](std::size_t m) {
    const double value = s.summaries[m].summary().mean;
    return std::isnan(value) ? HUGE_VAL : value;
  };
  std::vector<std::size_t> order(cell.methods.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return mean(a) < mean(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto m = order[i];
    const auto& summary = s.summaries[m].summary();
    const auto& tail = s.tails[m].tail();
    ranking.methods.push_back({cell.methods[m].id, summary.mean, summary.half_width_95,
                               s.ranks.mean_rank(m), tail.value, summary.worst, tail.low, tail.high,
                               s.diverged[m], s.broken_down[m], summary.missing});
  }
  for (std::size_t better = 0; better < order.size(); ++better)
    for (std::size_t worse = better + 1; worse < order.size(); ++worse)
      ranking.pairs.push_back({better, worse, s.pairs->difference(order[worse], order[better])});
  std::vector<std::size_t> contenders;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (cell.methods[order[i]].role().is_contender()) contenders.push_back(i);
  if (s.trials > 1 && !contenders.empty() && !std::isnan(ranking.methods[contenders[0]].mean)) {
    ranking.winner = ranking.methods[contenders[0]].method;
    for (const auto& pair : ranking.pairs)
      ranking.winner_is_shared |=
          pair.better == contenders[0] && !pair.difference.separable &&
          std::find(contenders.begin(), contenders.end(), pair.worse) != contenders.end();
  }
  if (s.trials > 0) ranking.share_worse = 1.0 - std::pow(0.05, 1.0 / static_cast<double>(s.trials));
  ranking.critical_difference = s.ranks.critical_difference();
  ranking.friedman_p = s.ranks.friedman_p();
  ranking.not_separable = Groups(ranking).all();
  ranking.sentences = ranking_sentences(cell, ranking);
  return ranking;
}

CellRanking rank_cell(const Cell& cell, const CellResult& result, const std::string& name) {
  const TrialSource trials = [&](const auto& visit) {
    for (const auto& trial : result.trials)
      if (trial) visit(trial->calibration_converged, trial->numbers);
  };
  return rank_cell(cell, trials, name);
}

Table ranking_table(const CellRanking& ranking) {
  const auto& u = ranking.unit;
  Table table{.title = fmt::format("{}: ranking by {}", ranking.cell, ranking.metric),
              .columns = {{"method", ""},
                          {"mean", u},
                          {"± 95 %", u},
                          {"mean rank", "1"},
                          {"CVaR95", u},
                          {"from", u},
                          {"to", u},
                          {"worst", u},
                          {"diverged", ""},
                          {"broke down", ""}},
              .notes = ranking.sentences};
  for (const auto& m : ranking.methods)
    table.rows.push_back({m.method, cell(m.mean), cell(m.half_width), cell(m.mean_rank),
                          cell(m.cvar95), cell(m.cvar95_low), cell(m.cvar95_high), cell(m.worst),
                          out_of(m.diverged, ranking.trials),
                          out_of(m.broken_down, ranking.trials)});
  table.notes.push_back(
      fmt::format("CVaR95: mean of the worst 5 % of trials, with its 95 % interval; worst: fewer "
                  "than {:.2g} % of all "
                  "trials are worse than it, with 95 % confidence",
                  100.0 * ranking.share_worse));
  return table;
}

}  // namespace gyrostat
