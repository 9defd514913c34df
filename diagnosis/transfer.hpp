#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

class Simulator;

/// Where a metric went when the effects were added: nearer to what the recording shows, or away
/// from it, by more than chance moves it (95 %).
enum class Moved { closer, nowhere, away };
std::string_view name_of(Moved moved);

/// What a filter shows on the recording, and what the simulator promises of it before and after the
/// effects were added, by a metric that needs no truth.
struct Transfer {
  std::string filter, metric, unit;
  double real, before, after;
  Moved moved = Moved::nowhere;
};

/// Runs the filters of both studies over the recording and over `replicas` of either scenario, with
/// the parameters that the baseline gives them: standard deviation of the innovations, NIS, Allan
/// deviation of the compensated rate, and the range of the heading integrated from it where there
/// is a compass. At most two minutes' worth of samples go through the random-error filters.
std::vector<Transfer> transfer(const Simulator& simulator, const Series& recording,
                               const Scenario& before, const Scenario& after, std::size_t replicas);

}  // namespace gyrostat::gap
