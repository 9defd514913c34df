#pragma once

#include <vector>

namespace gyrostat::gap {

/// Slopes at each of these times, per unit of time, of a curve whose slope is a random walk and
/// which is seen in white noise, given all that was seen: the local linear trend of Harvey
/// ("Forecasting, Structural Time Series Models and the Kalman Filter", 1989, 2.3.2) with a smooth
/// level, which is a cubic smoothing spline (Wahba 1978), by a fixed-interval smoother (Rauch, Tung
/// and Striebel 1965). How much the slope walks for this noise is the most likely by the restricted
/// likelihood, with nothing known of where the curve began; where it walks farther than the noise
/// from one value to the next, the slope is that between the neighbours. Zeros of fewer than three
/// values.
std::vector<double> slopes_in_noise(const std::vector<double>& times,
                                    const std::vector<double>& values);

}  // namespace gyrostat::gap
