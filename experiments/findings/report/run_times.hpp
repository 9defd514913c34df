#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace gyrostat {

/// Nanoseconds per step by cell and method, as a run measured them last and wrote them into its
/// log. Empty where there is no log or no such line; a line that is not whole is passed over.
std::map<std::string, std::map<std::string, double>> run_times(const std::filesystem::path& log);

}  // namespace gyrostat
