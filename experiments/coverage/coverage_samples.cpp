#include <algorithm>
#include <cmath>

#include <gyrostat/analysis/innovations.hpp>
#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/consistency.hpp>
#include <gyrostat/analysis/statistics/proportion.hpp>
#include <gyrostat/analysis/statistics/sequential.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/coverage/coverage.hpp>
#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/run/stopping.hpp>
#include <gyrostat/experiments/run/trial.hpp>

namespace gyrostat::coverage_detail {
namespace {

std::size_t columns_of_a_method() { return metric_types().size() + Outcome::beside_metrics; }

std::size_t column(std::size_t method, std::string_view metric) {
  return method * columns_of_a_method() + metric_named(metric, "coverage");
}

TrialSource source_of(const std::vector<const std::vector<double>*>& trials) {
  return [&trials](const auto& visit) {
    for (const auto* outcomes : trials) visit(true, *outcomes);
  };
}

const RankedMethod& of(const CellRanking& ranking, const std::string& method) {
  return *std::find_if(ranking.methods.begin(), ranking.methods.end(),
                       [&](const RankedMethod& m) { return m.method == method; });
}

double signed_difference(const CellRanking& ranking, const std::string& a, const std::string& b) {
  return of(ranking, a).mean - of(ranking, b).mean;
}

/// Whether all simultaneous intervals of differences hold together.
bool all_differences_hold(const CellRanking& ranking, const CellRanking& truth) {
  return std::all_of(ranking.pairs.begin(), ranking.pairs.end(), [&](const RankedPair& pair) {
    const double expected = signed_difference(truth, ranking.methods[pair.worse].method,
                                              ranking.methods[pair.better].method);
    const auto& d = pair.difference;
    const double rounding = 1e-9 * (d.high - d.low) + 1e-15;
    return d.low - rounding <= expected && expected <= d.high + rounding;
  });
}

/// The share of the population that is worse than `value`.
double share_above(const Population& population, std::size_t at, double value) {
  std::size_t above = 0;
  for (const auto& trial : population.trials) above += std::abs(trial[at]) > value;
  return static_cast<double>(above) / static_cast<double>(population.trials.size());
}

/// Values of one column that a share of the population exceeds.
double threshold(const Population& population, std::size_t at, double share) {
  std::vector<double> values;
  for (const auto& trial : population.trials) values.push_back(trial[at]);
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>((1.0 - share) * static_cast<double>(values.size() - 1))];
}

/// What the numbers of a consistent filter, the oracle, stay within.
class Consistency {
 public:
  Consistency(const Cell& cell, std::size_t method) {
    for (const char* metric :
         {"nis", "nees", "nees_end", "innovation_lag_1", "ljung_box", "innovations", "pit_0"})
      columns_.push_back(column(method, metric));
    told_truth_ = cell.methods[method].role().is_bound();
  }

  void operator()(const std::vector<const std::vector<double>*>& sample, Coverage& coverage) const {
    if (!told_truth_) return;
    std::array<Running, 6> means;
    std::array<Running, Innovations::bins> pit;
    for (const auto* trial : sample) {
      for (std::size_t i = 0; i < means.size(); ++i) means[i].add((*trial)[columns_[i]]);
      for (std::size_t b = 0; b < pit.size(); ++b) pit[b].add((*trial)[columns_.back() + b]);
    }
    const auto& [nis, nees, nees_end, lag, box, count] = means;
    constexpr double alpha = 0.05;
    const double innovations = count.count * count.mean;
    double statistic = 0.0;
    for (const auto& share : pit)
      statistic += innovations * (share.mean - 0.1) * (share.mean - 0.1) / 0.1;
    const double q = chi_squared_bound(Innovations::lags * box.count, alpha).high / box.count;
    coverage.add("nis", mean_square_bounds(innovations, alpha).contains(nis.mean));
    coverage.add("lag_1", correlation_bounds(innovations, alpha).contains(lag.mean));
    coverage.add("ljung_box", box.mean <= q);
    coverage.add("pit", chi_squared_bound(9.0, alpha).contains(statistic));
    coverage.add("nees", trial_mean_bounds(nees, 1.0, alpha).contains(nees.mean));
    coverage.add("nees_end", mean_square_bounds(nees_end.count, alpha).contains(nees_end.mean));
  }

 private:
  std::vector<std::size_t> columns_;
  bool told_truth_ = false;
};

}  // namespace

std::vector<Coverage> of_samples(const CoverageStudy& study, const Population& population,
                                 std::uint32_t size) {
  const Cell& cell = population.cell;
  std::vector<const std::vector<double>*> everything;
  for (const auto& trial : population.trials) everything.push_back(&trial);
  const auto truth = rank_cell(cell, source_of(everything));
  const auto heading_truth = rank_cell(cell, source_of(everything), "heading_worst");
  const auto make = [&](const char* interval) { return Coverage{interval, cell.name, size, {}}; };
  Coverage means = make("mean"), tails = make("CVaR95 (Hall)");
  Coverage pairs = make("differences, all pairs at once"),
           shares = make("share of trials (Wilson)");
  Coverage worst = make("share worse than the worst"), consistent = make("consistency bounds");
  const std::size_t judged = column(cell.methods.size() - 1, judging_metric(cell));
  const double half = threshold(population, judged, 0.5),
               tenth = threshold(population, judged, 0.1);

  std::vector<Consistency> checks;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) checks.emplace_back(cell, m);

  std::vector<const std::vector<double>*> sample(size);
  for (std::uint32_t s = 0; s < study.samples; ++s) {
    const Draws draw(study, population, s, "samples/" + std::to_string(size));
    for (std::uint32_t i = 0; i < size; ++i) sample[i] = &draw(i);
    for (const auto* expected : {&truth, &heading_truth}) {
      const auto found = rank_cell(cell, source_of(sample), expected->metric);
      pairs.add(expected->metric, all_differences_hold(found, *expected));
      for (const auto& m : found.methods) {
        const auto& t = of(*expected, m.method);
        const auto name = expected->metric + " of " + m.method;
        means.add(name, m.mean - m.half_width, t.mean, m.mean + m.half_width);
        tails.add(name, m.cvar95_low, t.cvar95, m.cvar95_high);
      }
      if (expected != &truth) continue;
      const auto& last = of(found, cell.methods.back().id);
      worst.add(last.method, share_above(population, judged, last.worst) <= found.share_worse);
    }
    for (const auto& [limit, name] : {std::pair(half, "half"), std::pair(tenth, "a tenth")}) {
      double hits = 0.0;
      for (const auto* trial : sample) hits += (*trial)[judged] > limit;
      const auto [low, high] = wilson_interval(hits, size, 0.95);
      shares.add(name, low, share_above(population, judged, limit), high);
    }
    // Their truth is theory, from which the population's own mean differs by a spread of its own.
    if (40 * size <= population.trials.size())
      for (const auto& check : checks) check(sample, consistent);
  }
  return {means, tails, pairs, shares, worst, consistent};
}

std::vector<Coverage> of_stopped_samples(const CoverageStudy& study, const Population& population,
                                         std::uint32_t first) {
  Cell cell = population.cell;
  if (cell.methods.size() < 2) return {};
  std::vector<const std::vector<double>*> sample;
  for (const auto& trial : population.trials) sample.push_back(&trial);
  const auto truth = rank_cell(cell, source_of(sample));
  const double trials_wanted = 4.0 * first;
  const auto make = [&](const char* interval) { return Coverage{interval, cell.name, first, {}}; };
  Coverage narrow = make("mean where a width stopped");
  Coverage apart = make("difference where a separation stopped");
  Coverage throughout = make("difference at all looks of a separation");
  const auto counts = look_counts(first, 16 * first);

  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    Running whole;
    const std::size_t at = column(m, judging_metric(cell));
    for (const auto& trial : population.trials) whole.add(trial[at]);
    cell.stop =
        StopRule{.metric = metric_named(judging_metric(cell), "coverage"),
                 .methods = {m},
                 .at_least = first,
                 .half_width_below = 1.96 * std::sqrt(whole.squares / whole.count / trials_wanted)};
    for (std::uint32_t s = 0; s < study.samples; ++s) {
      const Draws draw(study, population, s, "width/" + std::to_string(m));
      for (const auto n : counts) {
        const OutcomeSource outcomes = [&](const auto& visit) {
          for (std::uint32_t i = 0; i < n; ++i) visit(draw(i));
        };
        if (!stop_reason(cell, n, outcomes) && n != counts.back()) continue;
        Running mean;
        outcomes([&](std::span<const double> trial) { mean.add(trial[at]); });
        const double half_width = half_width_95(mean);
        narrow.add(cell.methods[m].id, mean.mean - half_width, whole.mean, mean.mean + half_width);
        break;
      }
    }
  }

  for (std::size_t m = 0; m + 1 < cell.methods.size(); ++m) {
    const std::size_t a = column(m, judging_metric(cell)), b = a + columns_of_a_method();
    cell.stop = StopRule{.metric = metric_named(judging_metric(cell), "coverage"),
                         .methods = {m, m + 1},
                         .at_least = first};
    std::vector<double> families;
    for (const auto n : counts) families.push_back(comparisons_of_looks(cell, n));
    const double expected =
        of(truth, cell.methods[m].id).mean - of(truth, cell.methods[m + 1].id).mean;
    const auto name = cell.methods[m].id + " - " + cell.methods[m + 1].id;
    // As it is, and with the two exchanged at random: then they do not differ, and every stop is an
    // error.
    for (const bool exchanged : {false, true})
      for (std::uint32_t s = 0; s < study.samples; ++s) {
        const Draws draw(study, population, s, "separation/" + std::to_string(m));
        const NormalStream coins(study.seed, s, "coins");
        std::vector<double> differences;
        bool all = true, stopped = false;
        for (std::size_t k = 0; k < counts.size(); ++k) {
          const auto n = counts[k];
          while (differences.size() < n) {
            const auto& trial = draw(differences.size());
            const bool turn = exchanged && coins.uniform(differences.size()) < 0.5;
            differences.push_back(turn ? trial[b] - trial[a] : trial[a] - trial[b]);
          }
          Running d;
          for (const double v : differences) d.add(v);
          const auto difference = paired_difference(d, families[k]);
          const double true_difference = exchanged ? 0.0 : expected;
          const bool holds =
              difference.low <= true_difference && true_difference <= difference.high;
          all = all && holds;
          if (!stopped && (difference.separable || n == counts.back())) {
            apart.add(name + (exchanged ? ", exchanged" : ""), holds);
            stopped = true;
          }
        }
        throughout.add(name + (exchanged ? ", exchanged" : ""), all);
      }
  }
  return {narrow, apart, throughout};
}

}  // namespace gyrostat::coverage_detail
