#pragma once

#include <span>

#include "experiments/trial.hpp"

namespace gyrostat {

/// Trials that this machine runs best side by side: as many as its widest registers hold.
std::uint32_t default_lanes();

/// The numbers of trials that may run side by side.
inline constexpr std::array<std::uint32_t, 4> possible_lanes = {1, 2, 4, 8};

/// What `run_trial` gives for each of `trials`, bit for bit, with filters that pack trials run over
/// all of them at once: where there are kernels for so many and all signals are as long. Seconds
/// and steps of each method are counted in the first workspace.
std::vector<Record> run_trial_pack(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                                   std::span<const std::uint32_t> trials,
                                   std::vector<Workspace>& workspaces);

}  // namespace gyrostat
