#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/core/table.hpp>
#include <gyrostat/core/track.hpp>
#include <gyrostat/experiments/study/method.hpp>

namespace gyrostat {

/// Methods as they ran over one recording.
struct Application {
  std::optional<Calibration> calibration;
  double judged_from_s = 0.0;  ///< from the first sample; what lies before was calibrated on
  std::vector<Method> methods;
  std::vector<Track> tracks;  ///< one a method
};

/// The methods of a file {"filters": [...]}: parameters that it does not give have their defaults.
std::vector<Method> read_application_config(const std::string& path);

/// Fits the first `fraction` of the recording.
Application calibrated(const Series& series, double fraction, FitMethod method);

/// Runs those `methods` whose channels the series has, over all of it; says in `log` which were
/// left out and why.
void apply_methods(const std::vector<Method>& methods, const Series& series, std::ostream& log,
                   Application& application);

/// Raw against compensated: statistics, and Allan deviations at decades of tau.
std::vector<Table> application_tables(const Series& series, const Application& application,
                                      const std::string& name);

/// t_s, raw_dps, and per method <id>_estimate_dps, <id>_innovation_dps, <id>_innovation_variance
/// (dps^2) and <id>_status, with 17 significant digits; blank where there is no value.
void write_application(const std::filesystem::path& path, const Series& series,
                       const Application& application);

}  // namespace gyrostat
