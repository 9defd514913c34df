#include <gyrostat/experiments/findings/consistency.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <gyrostat/analysis/innovations.hpp>
#include <gyrostat/analysis/statistics/consistency.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t tests_per_method = 7;
constexpr double within_3_sigma_of_normal = 0.99730020393674;

std::string spread_verdict(double value, const Acceptance& bounds, bool large_is_bold) {
  if (std::isnan(value) || std::isnan(bounds.low)) return "–";
  if (bounds.contains(value)) return "consistent";
  return (value > bounds.high) == large_is_bold ? "over-confident" : "conservative";
}

std::string white_verdict(double value, const Acceptance& bounds) {
  if (std::isnan(value) || std::isnan(bounds.low)) return "–";
  return bounds.contains(value) ? "white" : "correlated";
}

/// A histogram that leans to one side more than its ends stand out tells of a bias.
std::string pit_verdict(double value, const Acceptance& bounds,
                        const std::array<double, 10>& shares) {
  if (std::isnan(value) || std::isnan(bounds.high)) return "–";
  if (bounds.contains(value)) return "consistent";
  const double upper = std::accumulate(shares.begin() + 5, shares.end(), 0.0);
  const double ends = shares.front() + shares.back();
  if (std::abs(upper - 0.5) > std::abs(ends - 0.2)) return "skewed";
  return ends > 0.2 ? "over-confident" : "conservative";
}

class Tester {
 public:
  Tester(const Cell& cell, const CellSummary& summary, std::size_t method, double alpha)
      : summary_(summary), method_(method), id_(cell.methods[method].id), alpha_(alpha) {}

  std::vector<ConsistencyTest> all() {
    const auto& count = of("innovations");
    const double innovations = count.count * count.mean;
    spread("nis", mean_of("nis"), 1.0, mean_square_bounds(innovations, alpha_), true);
    const auto lag = correlation_bounds(innovations, alpha_);
    add("lag_1", mean_of("innovation_lag_1"), 0.0, lag,
        white_verdict(mean_of("innovation_lag_1"), lag));
    const auto& box = of("ljung_box");
    auto box_bound = chi_squared_bound(Innovations::lags * box.count, alpha_);
    box_bound.high /= box.count;
    add("ljung_box", mean_of("ljung_box"), Innovations::lags, box_bound,
        white_verdict(mean_of("ljung_box"), box_bound));
    pit(innovations);
    spread("nees", mean_of("nees"), 1.0, trial_mean_bounds(of("nees"), 1.0, alpha_), true);
    spread("nees_end", mean_of("nees_end"), 1.0, mean_square_bounds(of("nees_end").count, alpha_),
           true);
    spread("within_3_sigma", mean_of("within_3_sigma"), within_3_sigma_of_normal,
           trial_mean_bounds(of("within_3_sigma"), within_3_sigma_of_normal, alpha_), false);
    return std::move(tests_);
  }

 private:
  const Running& of(std::string_view metric) const { return summary_.running(method_, metric); }
  double mean_of(std::string_view metric) const {
    return of(metric).count > 0.0 ? of(metric).mean : no_value;
  }
  void add(const char* test, double value, double expected, const Acceptance& bounds,
           std::string verdict) {
    tests_.push_back({id_, test, value, expected, bounds.low, bounds.high, std::move(verdict)});
  }
  void spread(const char* test, double value, double expected, const Acceptance& bounds,
              bool large_is_bold) {
    add(test, value, expected, bounds, spread_verdict(value, bounds, large_is_bold));
  }
  void pit(double innovations) {
    const auto shares = pit_histogram(summary_, method_);
    double statistic = 0.0;
    for (const double share : shares)
      statistic += innovations * (share - 0.1) * (share - 0.1) / 0.1;
    const auto bound = chi_squared_bound(9.0, alpha_);
    add("pit", statistic, 9.0, bound, pit_verdict(statistic, bound, shares));
  }

  const CellSummary& summary_;
  std::size_t method_;
  std::string id_;
  double alpha_;
  std::vector<ConsistencyTest> tests_;
};

}  // namespace

std::array<double, 10> pit_histogram(const CellSummary& summary, std::size_t method) {
  std::array<double, 10> shares;
  for (std::size_t b = 0; b < shares.size(); ++b) {
    const auto& share = summary.running(method, fmt::format("pit_{}", b));
    shares[b] = share.count > 0.0 ? share.mean : no_value;
  }
  return shares;
}

std::vector<ConsistencyTest> consistency_tests(const Cell& cell, const CellSummary& summary) {
  const double alpha = 0.05 / static_cast<double>(tests_per_method * cell.methods.size());
  std::vector<ConsistencyTest> tests;
  for (std::size_t m = 0; m < cell.methods.size(); ++m)
    for (auto& test : Tester(cell, summary, m, alpha).all()) tests.push_back(std::move(test));
  return tests;
}

Table consistency_table(const Cell& cell, const CellSummary& summary) {
  Table table{.title = cell.name + ": consistency of each filter with what it states of itself",
              .columns = {{"method", ""},
                          {"NIS", "1"},
                          {"innovations", ""},
                          {"lag 1", "1"},
                          {"whiteness", ""},
                          {"PIT", ""},
                          {"NEES", "1"},
                          {"± 95 %", "1"},
                          {"covariance", ""},
                          {"inside ±3σ", "%"},
                          {"diverged", ""},
                          {"broke down", ""},
                          {"breakdown steps", ""}}};
  const auto tests = consistency_tests(cell, summary);
  const auto out_of = [&](std::size_t count) -> TableCell {
    return fmt::format("{}/{}", count, summary.finished);
  };
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto* test = &tests[m * tests_per_method];
    const auto& method = summary.methods[m];
    const bool white = test[1].verdict == "white" && test[2].verdict == "white";
    const auto covariance = test[4].verdict != "consistent" ? test[4].verdict : test[5].verdict;
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(test[0].value), test[0].verdict,
                          gyrostat::cell(test[1].value),
                          test[1].verdict == "–" ? "–"
                          : white                ? "white"
                                                 : "correlated",
                          test[3].verdict, gyrostat::cell(test[4].value),
                          gyrostat::cell(summary.of(m, "nees").half_width_95), covariance,
                          gyrostat::cell(100.0 * test[6].value), out_of(method.diverged),
                          out_of(method.broken_down),
                          static_cast<std::int64_t>(method.breakdown_steps)});
  }
  table.notes.push_back(
      "of a consistent filter NIS and NEES are 1, innovations are white and 99.73 % of errors lie "
      "inside ±3σ; "
      "verdicts hold together with 95 % confidence, and with many innovations they notice "
      "departures "
      "that do not matter: look at the number. gyrostat consistency has bounds and PIT histograms");
  return table;
}

std::vector<Table> consistency_details(const Cell& cell, const CellSummary& summary) {
  Table bounds{.title = cell.name +
                        ": consistency tests, with bounds that hold together with 95 % confidence",
               .columns = {{"method", ""},
                           {"test", ""},
                           {"value", "1"},
                           {"expected", "1"},
                           {"low", "1"},
                           {"high", "1"},
                           {"verdict", ""},
                           {"diverged", ""},
                           {"broke down", ""}}};
  const auto tests = consistency_tests(cell, summary);
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const auto& [method, test, value, expected, low, high, verdict] = tests[t];
    const auto& of = summary.methods[t / tests_per_method];
    bounds.rows.push_back({method, test, gyrostat::cell(value), expected, gyrostat::cell(low),
                           gyrostat::cell(high), verdict,
                           fmt::format("{}/{}", of.diverged, summary.finished),
                           fmt::format("{}/{}", of.broken_down, summary.finished)});
  }
  Table pit{
      .title = cell.name +
               ": share of innovations in each tenth of what the filter foretold (0.1 each if "
               "it is consistent)",
      .columns = {{"method", ""}}};
  for (int b = 0; b < 10; ++b)
    pit.columns.push_back({fmt::format("{}–{} %", 10 * b, 10 * b + 10), "1"});
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    auto& row = pit.rows.emplace_back(std::vector<TableCell>{cell.methods[m].id});
    for (const double share : pit_histogram(summary, m)) row.push_back(gyrostat::cell(share));
  }
  pit.notes.push_back(
      "more at both ends: over-confident; more in the middle: conservative; leaning to one "
      "side: the innovations have a mean");
  return {bounds, pit};
}

}  // namespace gyrostat
