#include <gyrostat/diagnosis/gap/local_trend.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <Eigen/LU>

namespace gyrostat::gap {
namespace {

constexpr double smallest_walk = 1e-12, e_fold = 1.0;
constexpr int walks = 42;
constexpr double clear = 1.0;          // neighbours tell the slope
constexpr double unknown_slope = 1e8;  // variances of a slope, over that of what two values tell

using State = Eigen::Vector2d;
using Covariance = Eigen::Matrix2d;

/// From one value to one that is `time` later.
Covariance transition(double time) {
  Covariance f;
  f << 1.0, time, 0.0, 1.0;
  return f;
}

Covariance walked(double time, double ratio) {
  Covariance q;
  q << time * time * time / 3.0, time * time / 2.0, time * time / 2.0, time;
  return ratio * q;
}

/// Level and slope given the values so far, from the second on, in units of the noise's variance.
struct Filtered {
  std::vector<State> states;
  std::vector<Covariance> covariances;
  double deviance = 0.0;  ///< -2 log restricted likelihood, the noise concentrated out
};

Filtered filtered(const std::vector<double>& intervals, const std::vector<double>& values,
                  double ratio) {
  Filtered f;
  const double first = intervals[0];
  State x(values[1], (values[1] - values[0]) / first);
  Covariance p;
  p << 1.0, 1.0 / first, 1.0 / first, 2.0 / (first * first) + ratio * first / 3.0;
  f.states.push_back(x);
  f.covariances.push_back(p);
  double squares = 0.0, log_determinant = 0.0;
  for (std::size_t k = 2; k < values.size(); ++k) {
    const auto forth = transition(intervals[k - 1]);
    x = forth * x;
    p = forth * p * forth.transpose() + walked(intervals[k - 1], ratio);
    const double innovation = values[k] - x[0], variance = p(0, 0) + 1.0;
    const State gain = p.col(0) / variance;
    x += gain * innovation;
    p -= gain * gain.transpose() * variance;
    squares += innovation * innovation / variance;
    log_determinant += std::log(variance);
    f.states.push_back(x);
    f.covariances.push_back(p);
  }
  const auto freedom = static_cast<double>(values.size() - 2);
  f.deviance = log_determinant + freedom * std::log(std::max(squares, 1e-300));
  return f;
}

/// Given what comes after it, too.
State smoothed(const State& x, const Covariance& p, double time, double ratio, const State& after) {
  const auto forth = transition(time);
  const Covariance predicted = forth * p * forth.transpose() + walked(time, ratio);
  return x + p * forth.transpose() * predicted.inverse() * (after - forth * x);
}

std::vector<double> slopes_of_neighbours(const std::vector<double>& times,
                                         const std::vector<double>& values) {
  std::vector<double> slopes;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, values.size() - 1);
    slopes.push_back((values[after] - values[before]) / (times[after] - times[before]));
  }
  return slopes;
}

}  // namespace

std::vector<double> slopes_in_noise(const std::vector<double>& times,
                                    const std::vector<double>& values) {
  if (values.size() < 3) return std::vector<double>(values.size(), 0.0);
  const double unit = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  std::vector<double> intervals;
  for (std::size_t k = 1; k < times.size(); ++k)
    intervals.push_back((times[k] - times[k - 1]) / unit);
  double ratio = smallest_walk, least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < walks; ++k) {
    const double tried = smallest_walk * std::exp(e_fold * k);
    const double deviance = filtered(intervals, values, tried).deviance;
    if (deviance < least) {
      least = deviance;
      ratio = tried;
    }
  }
  if (ratio > clear) return slopes_of_neighbours(times, values);
  const auto seen = filtered(intervals, values, ratio);
  std::vector<double> slopes(values.size());
  State x = seen.states.back();
  slopes.back() = x[1] / unit;
  for (std::size_t k = values.size() - 2; k > 0; --k) {
    x = smoothed(seen.states[k - 1], seen.covariances[k - 1], intervals[k], ratio, x);
    slopes[k] = x[1] / unit;
  }
  const double told = seen.covariances.front()(1, 1);
  const Covariance begun = State(1.0, unknown_slope * told).asDiagonal();
  slopes.front() = smoothed({values[0], 0.0}, begun, intervals[0], ratio, x)[1] / unit;
  return slopes;
}

}  // namespace gyrostat::gap
