#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {

/// Amplitude and phase of hard or soft iron, by its sine and its cosine, in both forms.
template <class Iron>
std::vector<Iron> irons(const Evidence& e) {
  const auto columns = signatures(e, Trace::heading, {Iron{0.1, 0.0}, Iron{0.1, 90.0}});
  const Eigen::VectorXd found = 0.1 * match(columns, trace_of(e, Trace::heading)).amplitudes;
  const double amplitude_deg = std::hypot(found[0], found[1]);
  const double phase_deg = std::atan2(found[1], found[0]) * 180.0 / std::numbers::pi;
  return {{amplitude_deg, phase_deg, 0.0}, {amplitude_deg, phase_deg, 1.0}};
}

}  // namespace gyrostat::gap
