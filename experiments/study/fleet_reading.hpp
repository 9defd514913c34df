#pragma once

#include <memory>
#include <string>

#include <gyrostat/experiments/study/fleet.hpp>
#include <gyrostat/experiments/study/recorded.hpp>

namespace gyrostat {

/// The fleet that `gyrostat diagnose A.csv B.csv ... --json FILE` wrote: of each sensor its
/// "enriched" scenario and the 95 % intervals of its "effects"; all else there is not looked at.
/// Throws InputError that names file and JSON path.
std::shared_ptr<Fleet> read_fleet(const std::string& path, FittedRecordings& fits);

}  // namespace gyrostat
