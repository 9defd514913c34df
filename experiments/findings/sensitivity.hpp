#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/sensitivity/indices.hpp>
#include <gyrostat/analysis/sensitivity/surrogate.hpp>
#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// What a design says of one method's metric; the list that the design allows is filled.
struct Sensitivity {
  std::string design{};  ///< its place in the study: the cell's name before it was expanded
  std::string kind{};    ///< of the design: "saltelli", "morris", ...
  std::string method{}, metric{}, unit{};
  std::size_t trials = 0;          ///< most finished trials of a point
  std::size_t missing_values = 0;  ///< finished trials in which the metric has no value
  std::size_t points = 0,
              failed_points = 0;  ///< points left out because no trial of theirs finished
  std::vector<Elasticity> elasticities{};
  std::vector<ElementaryEffect> elementary_effects{};
  std::vector<SobolIndex> indices{};
  /// What the trials' noise alone comes to: for Morris the mu* that it would feign (value alone,
  /// the metric's unit), for Sobol' indices the variance of a point's mean as a share of the
  /// output's variance.
  Estimate noise{};
  std::optional<Surrogate>
      surrogate{};                    ///< of a design of that kind, its indices moved to `indices`
  std::vector<std::string> labels{};  ///< by point: what it is in the design
  std::vector<std::vector<double>>
      coordinates{};  ///< by point, by parameter; NaN where it is no number
  std::vector<std::string> parameters{}, units{};
  std::vector<double> means{}, standard_errors{};  ///< of the metric, by point
  std::vector<std::size_t>
      failures{};  ///< trials in which the method broke down or threw, by point

  std::size_t failed_trials() const;  ///< over all points
};

/// Whether a design of that kind says what matters; the points of one that does serve it alone.
bool has_sensitivities(DesignKind kind);

/// One number of one method over the points of a design.
struct DesignOutputs {
  Outputs outputs;
  std::vector<double> means{}, standard_errors{};
  std::vector<std::size_t> failed{};  ///< trials, by point
  std::size_t missing = 0, most = 0, empty_points = 0;

  /// The next point's mean and its standard error, of values of which some may be missing.
  void add_point(std::span<const double> values);
};

/// What a design says of such a number, `name` in `unit`.
Sensitivity sensitivity_of(const Design& design, const std::string& method, const std::string& name,
                           const std::string& unit, const DesignOutputs& outputs,
                           Resampler& resampler);

/// Which metric, and of which method; empty: the judging metric, all methods but the oracle.
struct SensitivityChoice {
  std::string metric{}, method{};
};

/// Hands every finished trial of a cell of the study to `visit`, in order.
using CellTrials = std::function<void(
    std::size_t cell,
    const std::function<void(std::uint32_t trial, std::span<const double> outcomes)>& visit)>;

/// Of every design of a study, every method but the oracle, in the judging metric, or as chosen.
/// Throws InputError with the nearest name for a metric or method that there is not.
std::vector<Sensitivity> sensitivities(const Study& study, const Store& store);
std::vector<Sensitivity> sensitivities(const Study& study, const Store& store,
                                       const SensitivityChoice& choice);
std::vector<Sensitivity> sensitivities(const Study& study, const CellTrials& trials,
                                       const SensitivityChoice& choice);

/// Elasticities, mu* and sigma, or indices of all methods of a design, in the design's order; one
/// table a design, none where the design has no such numbers.
std::vector<Table> sensitivity_tables(const std::vector<Sensitivity>& sensitivities,
                                      const Study& study);

/// The points of each design with the mean of each method, one table a design.
std::vector<Table> point_tables(const std::vector<Sensitivity>& sensitivities, const Study& study);

}  // namespace gyrostat
