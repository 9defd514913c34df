#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/findings/allan_table.hpp>

namespace gyrostat {

/// What a fit to a recording says: parameters with their 95 % intervals, then the coefficients of
/// IEEE 952 of what the drift leaves.
struct FitTables {
  std::vector<Table> tables;
  std::vector<Calibration>
      fits;  ///< one a method, in the order asked for; later ones only where they can be had
  bool converged = false;  ///< one of them at least
  AllanFindings left;      ///< of the rate without its drift; empty where samples are missing
  std::string json;        ///< an object: values and intervals under their names
};

/// What is done, and which share of all that is.
using FitProgress = std::function<void(const std::string& phase, double share)>;

/// Fits phi, delta1, delta2 and R by each of the methods, and a, b, c where there is temperature.
/// `name` is what title and messages call the recording, `title` what its table does. Throws
/// InputError where it cannot be fitted.
FitTables fit_tables(const Series& series, std::span<const FitMethod> methods,
                     const std::string& name, const std::string& title,
                     const FitProgress& progress = {});

}  // namespace gyrostat
