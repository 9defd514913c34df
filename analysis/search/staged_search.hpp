#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/search/box_search.hpp>

namespace gyrostat {

/// The best of a box where every look is noise: a number a trial, common to all candidates.
struct StagedSearchPlan {
  std::size_t runs = 8000;        ///< of one candidate over one trial
  std::size_t first_trials = 16;  ///< on which all candidates are tried
  std::uint64_t seed = 1;         ///< of where the candidates lie
};

/// Where the search stood after a stage.
struct SearchStage {
  std::string what;            ///< "start", "halving 1", …, "surrogate 1", …
  std::size_t candidates = 0;  ///< that were looked at in it
  std::size_t trials = 0;      ///< each
  std::size_t runs = 0;        ///< so far
  std::vector<double> best{};
  double objective = no_value;  ///< of the best, on these trials
};

struct StagedSearchResult {
  std::vector<double> values;
  std::vector<SearchStage> stages;
};

/// The numbers of every candidate in the trials from `first` to before `last`, a row a candidate.
using CandidateTrials = std::function<std::vector<std::vector<double>>(
    const std::vector<std::vector<double>>& candidates, std::size_t first, std::size_t last)>;

/// Minimises the objective of trials over a box by successive halving (Karnin, Koren and Somekh,
/// ICML 2013; Jamieson and Talwalkar, AISTATS 2016): a third of the runs goes to `start` and the
/// points of a Sobol' sequence, of which after each rung the better half goes on to twice the
/// trials. The rest goes to a local surrogate (a response surface, Box and Wilson, JRSS B 13,
/// 1951): about the best so far a quadratic is fitted to the objective at new points, all on the
/// same trials, its minimum is tried, and the region shrinks by half; twice more. From seven
/// parameters on the quadratic has no products. All candidates see the same trials (common random
/// numbers), and each trial of a candidate is run once. Deterministic; an objective that is NaN or
/// infinite counts as worst.
///
/// Example: the minimum of a valley of which each trial sees another slope.
///
///   const auto found = staged_search({{-2, 2}}, {1.0}, {.runs = 2000},
///       [](const auto& candidates, std::size_t first, std::size_t last) {
///         std::vector<std::vector<double>> numbers;
///         for (const auto& x : candidates)
///           for (auto& row = numbers.emplace_back(); first + row.size() < last;)
///             row.push_back(x[0] * x[0] + 0.1 * static_cast<double>(row.size() % 3));
///         return numbers;
///       },
///       [](std::span<const double> numbers) {
///         double sum = 0.0;
///         for (const double number : numbers) sum += number;
///         return sum / static_cast<double>(numbers.size());
///       });
StagedSearchResult staged_search(const std::vector<SearchRange>& ranges,
                                 const std::vector<double>& start, const StagedSearchPlan& plan,
                                 const CandidateTrials& run,
                                 const std::function<double(std::span<const double>)>& objective);

/// How far `value` is along the way from low to high, 0 to 1: the inverse of SearchRange::at.
double fraction_of(const SearchRange& range, double value);

}  // namespace gyrostat
