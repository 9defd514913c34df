#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// A parameter of a scenario on the scale that a fit moves it on.
struct Dial {
  std::function<double(const Scenario&)> get;
  std::function<void(Scenario&, double)> set;
  double furthest = 1.0;  ///< in one step of a fit
  /// The effect and the field of it that it moves, where it moves one.
  struct Place {
    std::size_t effect, field;
  };
  std::optional<Place> place = std::nullopt;
  std::string_view of = {};  ///< an effect, `white_noise` or `random_walk`
};

/// What a simulator has beside effects, as they are called among them.
inline constexpr std::string_view white_noise = "white_noise", random_walk = "random_walk";

/// On a logarithmic scale, from `low` to `high`.
Dial logarithmic(const std::function<double&(Scenario&)>& value, double low, double high);
/// The size of the walk, on a logarithmic scale; the memory beside it stays.
Dial size_of_walk(double low_dps, double high_dps);
/// In multiples of `unit`.
Dial linear(const std::function<double&(Scenario&)>& value, double unit);

/// The scenario with a walk so many times as large, the memory beside it as it is.
Scenario with_walk_times(Scenario scenario, double factor);

/// The scenario with a walk of that size at least.
Scenario with_walk_of_at_least(Scenario scenario, double walk_dps);

/// The scenario with every dial moved, each by its own.
Scenario moved(Scenario scenario, const std::vector<Dial>& dials, const Eigen::VectorXd& by);

}  // namespace gyrostat::gap
