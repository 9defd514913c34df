#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// What one method made of one trial, seen in the numbers that the store keeps of it: every metric
/// (in the order of metric_types(), NaN where there is no value), the steps of each Status, and
/// whether it diverged.
class Outcome {
 public:
  explicit Outcome(std::span<const double> numbers) : numbers_(numbers) {
    assert(numbers.size() >= beside_metrics);
  }

  std::size_t metric_count() const { return numbers_.size() - beside_metrics; }
  double metric(std::size_t m) const { return numbers_[m]; }
  double steps(Status status) const {
    return numbers_[metric_count() + static_cast<std::size_t>(status)];
  }
  double breakdown_steps() const {
    double steps_left_out = 0.0;
    for (std::size_t s = 0; s < status_names.size(); ++s)
      if (const auto status = static_cast<Status>(s); is_breakdown(status))
        steps_left_out += steps(status);
    return steps_left_out;
  }
  bool broke_down() const { return breakdown_steps() > 0.0; }
  /// A method that threw made no step at all.
  bool threw() const {
    for (std::size_t s = 0; s < status_names.size(); ++s)
      if (steps(static_cast<Status>(s)) != 0.0) return false;
    return true;
  }
  bool has_failed() const { return threw() || broke_down(); }
  bool diverged() const { return numbers_.back() != 0.0; }

  std::span<const double> numbers() const { return numbers_; }

  static constexpr std::size_t beside_metrics = status_names.size() + 1;

 private:
  std::span<const double> numbers_;
};

/// The outcomes of all methods of one trial, in their order.
class TrialOutcomes {
 public:
  TrialOutcomes(std::span<const double> numbers, std::size_t methods)
      : numbers_(numbers), methods_(methods) {}

  std::size_t size() const { return methods_; }
  Outcome operator[](std::size_t method) const {
    const std::size_t each = numbers_.size() / methods_;
    return Outcome(numbers_.subspan(method * each, each));
  }

 private:
  std::span<const double> numbers_;
  std::size_t methods_;
};

}  // namespace gyrostat
