#pragma once

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// How far a filter has come that does nothing between two epochs but hold its estimate and
/// integrate what the gyro turns beyond it. Who takes such samples in its stead, those of several
/// trials at once, hands back `last_s` and `turned_deg`.
template <class T>
struct HeldInterval {
  T from_s{no_value};   ///< where it began; no value before the first sample
  T least_s{no_value};  ///< an epoch is due where no less than this has passed
  T last_s{no_value};   ///< of the last sample
  T turned_deg{0.0};    ///< integral of the gyro without `compensated_dps`
  T compensated_dps{0.0};
  T estimate_dps{0.0};  ///< held, with its variance
  T estimate_variance{no_value};
};

}  // namespace gyrostat
