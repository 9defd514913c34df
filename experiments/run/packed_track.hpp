#pragma once

#include <span>

#include <gyrostat/experiments/run/trial.hpp>

namespace gyrostat {

/// Runs the method over the series of every workspace into its own track: packed where there is a
/// kernel for so many and all are alike, else one after the other; the same bits.
void track_together(const Method& method, std::span<const ParameterMap> told,
                    std::span<Workspace> workspaces);

}  // namespace gyrostat
