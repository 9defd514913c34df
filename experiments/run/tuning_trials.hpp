#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// Trials of a cell that its study never runs, with candidates in the place of one method: all
/// candidates see the same signals, and neither those of the search nor those that judge it meet
/// the study's or its calibrations'.
class TuningTrials {
 public:
  /// Throws InputError for a cell of a recording's pieces, which are too few to tune on some and be
  /// judged by others.
  TuningTrials(const Cell& cell, std::size_t method, std::uint64_t seed, std::size_t metric,
               const RunOptions& options);

  const PreparedCell& prepared() const { return prepared_; }
  const Method& method() const { return method_; }
  bool has(const std::string& parameter) const;
  std::string unit_of(const std::string& parameter) const;
  /// As the method has it in the cell, from its calibration.
  double value_of(const std::string& parameter) const;

  using Done = std::function<void(std::size_t trials)>;
  /// The error by candidate and trial from `first` to before `last`; NaN where a trial has
  /// no value. Throws Interrupted once the options' flag is set.
  std::vector<std::vector<double>> search(const std::vector<ParameterMap>& candidates,
                                          std::size_t first, std::size_t last,
                                          const Done& done) const;
  std::vector<std::vector<double>> fresh(const std::vector<ParameterMap>& candidates,
                                         std::size_t first, std::size_t last,
                                         const Done& done) const;

 private:
  std::vector<std::vector<double>> run(const std::vector<ParameterMap>& candidates,
                                       std::uint64_t seed, std::size_t first, std::size_t last,
                                       const Done& done) const;

  PreparedCell prepared_;
  Method method_;
  std::uint64_t seed_;
  std::size_t metric_;
  RunOptions options_;
};

}  // namespace gyrostat
