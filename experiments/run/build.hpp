#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// Of this very program: version and commit (with a digest of what is not committed), compiler,
/// flags.
Build this_build();

/// The same with the plug-ins that the study uses, which are part of what runs it: after the
/// version stands "with" and each one's name and code.
Build build_for(const Study& study);

/// The names of these plug-ins.
std::vector<std::string> plugins_of(const Build& build);

/// Processor, number of threads, host and system.
std::string this_machine();

/// Now, as 2026-11-21T13:50:22Z.
std::string utc_now();

}  // namespace gyrostat
