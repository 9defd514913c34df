#pragma once

#include <vector>

namespace gyrostat {

/// What an even sequence sums up to at evenly spaced angles: of values x_0 … x_n (n a power of two,
/// 1 at least) at the lags 0 … n of a period 2 n, the n + 1 sums
///   y_k = x_0 + 2 (x_1 cos(pi k / n) + … + x_(n-1) cos(pi k (n - 1) / n)) + (-1)^k x_n .
/// A covariance gives its density so; the same sums of y are 2 n x.
std::vector<double> cosine_sums(const std::vector<double>& values);

}  // namespace gyrostat
