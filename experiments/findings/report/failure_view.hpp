#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/findings/failures.hpp>

namespace gyrostat {

/// What the pictures of a cell's failure are drawn from.
struct FailureView {
  /// A method's error over time in the most likely failing signal, and in the plain trial that has
  /// the median of the metric.
  struct Signal {
    std::size_t method = 0;     ///< of the cell
    std::uint32_t typical = 0;  ///< the trial
    std::vector<double> failing_error, typical_error;
  };
  std::vector<FailureFinding> findings;
  /// The metric of the plain trials that have one, in order, the worst last; by finding.
  std::vector<std::vector<double>> plain;
  std::vector<Signal> signals;  ///< of those whose search reached its threshold
  std::vector<double> t_s;
  std::string error, unit;  ///< what the errors over time are
};

/// Of a cell that has a failure rule, number `index` of `study`; without signals where
/// `with_signals` is false, for they are simulated again.
FailureView failure_view(const Study& study, const Store& plain, std::uint32_t index,
                         const std::filesystem::path& folder, const PreparedCell& prepared,
                         bool with_signals);

}  // namespace gyrostat
