#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/experiments/run/trial.hpp>
#include <gyrostat/generators/packed/signal_in_lanes.hpp>

namespace gyrostat {

/// Trials that this machine runs best side by side, as measured: as many as its widest registers
/// hold, and twice as many in AVX-512, which has registers enough to fill what a filter waits for.
std::uint32_t default_lanes();

/// The record of a trial that no method could run in.
Record thrown_record(const Cell& cell, const std::string& thrown);

/// The numbers of trials that may run side by side.
inline constexpr std::array<std::uint32_t, 5> possible_lanes = {1, 2, 4, 8, 16};

/// Trials of a cell side by side, each with the bits that it has alone: filters that pack trials
/// run over all of them at once, where there are kernels for so many and all signals are as long.
/// `shared` is used unless the cell calibrates each trial. What a method throws is its outcome;
/// what signal or calibration throw is the outcome of all. A lack of memory is thrown on, and
/// Interrupted, which is no outcome.
/// Where they share `conditions` (shared_conditions of the cell's scenario) and no method or metric
/// asks for whole series, they stay in lanes from the deviates to the metrics, a stretch at a time.
/// Seconds and steps of each method are counted in the first workspace.
std::vector<Record> run_trials_together(const Cell& cell, const Calibration& shared,
                                        std::uint64_t seed, std::span<const std::uint32_t> trials,
                                        std::vector<Workspace>& workspaces,
                                        const SharedConditions* conditions = nullptr);

/// The same for trials of any noise.
std::vector<Record> run_trials_together(const Cell& cell, const Calibration& shared,
                                        std::span<const Noise> trials,
                                        std::vector<Workspace>& workspaces,
                                        const SharedConditions* conditions = nullptr);

/// One of them.
Record run_trial(const Cell& cell, const Calibration& shared, const Noise& trial,
                 std::vector<Workspace>& workspaces);
Record run_trial(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                 std::uint32_t trial, std::vector<Workspace>& workspaces);

}  // namespace gyrostat
