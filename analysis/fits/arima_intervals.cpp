#include <gyrostat/analysis/fits/arima_intervals.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>

#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>

namespace gyrostat {
namespace {

using Parameter = ArimaIntervals::Parameter;

constexpr double wald_is_good = 0.1;  ///< of a signed root, so far from where it should be

double value_of(Parameter parameter, const Arima111<double>& p) {
  return std::array{p.phi, p.delta1_dps, p.delta2_dps, p.measurement_noise_std_dps}[parameter];
}

}  // namespace

ArimaIntervals::ArimaIntervals(const ArimaFit& fit, std::span<const double> rate_dps)
    : profile_(rate_dps,
               fit.likeliest ? *fit.likeliest : fit_whole_arima_likelihood(rate_dps).parameters),
      reported_(fit.parameters),
      errors_(fit.standard_errors),
      needed_(2.0 * (arima_misfit(arima_sums(reported_, rate_dps)) - profile_.least_misfit())) {
  find_other_modes();
}

double ArimaIntervals::deviance(Parameter parameter, double value) const {
  return std::max(0.0, 2.0 * (profile_.point(parameter, value).misfit - profile_.least_misfit()));
}

void ArimaIntervals::find_other_modes() {
  constexpr std::array grid = {-0.99, -0.9, -0.6, -0.2, 0.2, 0.6, 0.85, 0.95, 0.99};
  constexpr double ridge = 0.5;  // of deviance, more than a descent leaves
  const double most = chi_squared_quantile(0.95, 4.0);
  const auto above = std::lower_bound(grid.begin(), grid.end(), reported_.phi);
  const auto look = [&](auto from, auto to) {
    double highest = needed_;  // since the last mode
    bool falls = false;
    for (; from != to; ++from) {
      const auto found = profile_.point(ArimaProfile::phi, *from);
      const double height = std::max(0.0, 2.0 * (found.misfit - profile_.least_misfit()));
      if (height > highest) falls = false;
      if (height < std::min(highest - ridge, most)) {
        if (falls) other_modes_.pop_back();
        other_modes_.push_back({found.at, height});
        falls = true;
        highest = height;
      }
      highest = std::max(highest, height);
    }
  };
  look(above, grid.end());
  look(std::make_reverse_iterator(above), grid.rend());
  for (const auto& mode : other_modes_) needed_ = std::max(needed_, mode.deviance);
}

double ArimaIntervals::end(Parameter parameter, double limit, double reach) const {
  double estimate = value_of(parameter, reported_);
  const double side = limit > estimate ? 1.0 : -1.0;
  for (const auto& mode : other_modes_)
    estimate = side * std::max(side * estimate, side * value_of(parameter, mode.parameters));
  const auto excess = [&](double v) {
    return v == estimate ? -reach : std::sqrt(deviance(parameter, v)) - reach;
  };

  // A parabola would have it here, where the fit is its bottom.
  const double error = value_of(parameter, errors_);
  const double typical = parameter == phi ? 0.2 : 0.5 * profile_.likeliest().delta1_dps;
  const bool has_error = std::isfinite(error) && error > 0.0;
  double step = has_error ? reach * error : typical;
  const auto within = [&](double v) { return side * (limit - v) > 0.0; };
  if (has_error && needed_ < wald_is_good && within(estimate + side * step))
    if (const double miss = excess(estimate + side * step); std::abs(miss) < wald_is_good)
      return estimate + side * step * reach / (reach + miss);

  if (std::isfinite(limit) && !(excess(limit) > 0.0)) return limit;
  double far = estimate + side * step;
  for (int i = 0; i < 40 && within(far) && excess(far) < 0.0; ++i)
    far = estimate + side * (step *= 2.0);
  if (!within(far)) far = limit;
  const double ends[] = {std::min(estimate, far), std::max(estimate, far)};
  std::uintmax_t most = 20;
  const auto close = [&](double a, double b) {
    return std::abs(a - b) < 0.01 * std::abs(0.5 * (a + b) - estimate);
  };
  const auto found = boost::math::tools::toms748_solve(excess, ends[0], ends[1], close, most);
  return 0.5 * (found.first + found.second);
}

double ArimaIntervals::reach(double confidence) const {
  const double normal = normal_quantile(0.5 + 0.5 * confidence);
  return std::max(normal, 1.001 * std::sqrt(std::max(0.0, needed_)));
}

std::array<double, 2> ArimaIntervals::interval(Parameter parameter, double confidence) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  constexpr double most = 1.0 - 1e-5;  // of |phi|
  std::array<double, 2> limits = {0.0, none};
  if (parameter == phi) limits = {-most, most};
  if (parameter == delta2) limits = {-none, none};
  std::array<double, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    ends[i] = end(parameter, limits[i], reach(confidence));
    if (parameter == phi && ends[i] == limits[i]) ends[i] = std::round(ends[i]);
  }
  return ends;
}

}  // namespace gyrostat
