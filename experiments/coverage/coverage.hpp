#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// A measurement of how often the program's 95 % intervals hold what they are for. Each cell of a
/// study is run many times over: its trials are a population, whose own mean, CVaR and so on are
/// the truth. Samples are drawn from it with replacement, which makes them independent however
/// large they are, and each interval is made of the sample by the code that makes it in a run.
struct CoverageStudy {
  std::string title;
  std::string study;                       ///< path of the study whose cells are the populations
  std::uint32_t population = 20000;        ///< trials of each cell
  std::uint32_t samples = 4000;            ///< drawn of each size
  std::vector<std::uint32_t> sizes;        ///< trials of a sample
  std::vector<std::uint32_t> first_looks;  ///< trials before a stop rule looks first
  std::string signals;                     ///< path of the study whose cells' signals are fitted
  std::uint32_t fits = 1000;  ///< signals of each, fitted and looked at by Allan deviation
  std::uint64_t seed = 1;     ///< of the draws
};

/// How often intervals of one kind held: each of `names` has its own truth.
struct Coverage {
  std::string interval, cell;
  std::uint32_t size = 0;  ///< trials, those before the first look, or samples of a signal
  struct Count {
    std::string name;
    std::uint32_t hits = 0, intervals = 0;
    std::uint32_t none = 0;  ///< samples that gave no interval
    double share() const { return static_cast<double>(hits) / intervals; }
  };
  std::vector<Count> counts;

  void add(const std::string& name, double low, double truth, double high);
  void add(const std::string& name, bool holds);

 private:
  Count& count_of(const std::string& name);
};

CoverageStudy read_coverage(const std::string& path);

/// Every kind of interval, by cell and size of sample. `run` gives the result of a cell.
std::vector<Coverage> measure_coverage(
    const CoverageStudy& study, const std::function<CellResult(const Study&, const Cell&)>& run);

/// One row a kind of interval, cell and size.
Table coverage_table(const CoverageStudy& study, const std::vector<Coverage>& coverages);

namespace coverage_detail {

/// A cell's trials as the store would have them.
struct Population {
  const Cell& cell;
  std::vector<std::vector<double>> trials;
};

/// Means, medians' neighbours and shares of samples of fixed size.
std::vector<Coverage> of_samples(const CoverageStudy& study, const Population& population,
                                 std::uint32_t size);
/// Intervals at the trial at which a rule stops that looks first after `first` trials.
std::vector<Coverage> of_stopped_samples(const CoverageStudy& study, const Population& population,
                                         std::uint32_t first);
/// Standard errors of fits, and Allan deviations, of signals of a cell's scenario.
std::vector<Coverage> of_signals(const CoverageStudy& study, const Study& cells, const Cell& cell);

/// The trial that draw `i` of sample `sample` takes.
class Draws {
 public:
  Draws(const CoverageStudy& study, const Population& population, std::uint32_t sample,
        const std::string& what);
  const std::vector<double>& operator()(std::uint64_t i) const;

 private:
  const Population& population_;
  NormalStream stream_;
};

}  // namespace coverage_detail
}  // namespace gyrostat
