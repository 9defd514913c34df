#pragma once

#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// Of this very program: version and commit (with a digest of what is not committed), compiler,
/// flags.
Build this_build();

/// Processor, number of threads, host and system.
std::string this_machine();

/// Now, as 2026-11-21T13:50:22Z.
std::string utc_now();

}  // namespace gyrostat
