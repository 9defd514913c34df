#pragma once

#include <gyrostat/core/models/no_parameters.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

/// The uncompensated gyro, the bound from above: an estimate of zero at every sample.
template <class T>
class None {
 public:
  using Scalar = T;
  using Parameters = NoParameters<T>;
  static constexpr std::string_view title = "no compensation";
  static constexpr Needs needs{};
  static constexpr Role role{.rank = Role::Rank::floor};
  static constexpr bool packs_trials = true;

  explicit None(const Parameters& /*none*/) {}

  Step<T> step(const Sample<T>& /*sample*/) { return {}; }
};

}  // namespace gyrostat::filters
