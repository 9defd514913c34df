#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {

std::vector<ParameterInterval> SetBench::intervals_of(const Standing& standing) const {
  auto found = standing.fitter->intervals(standing.fit);
  for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k)
    if (is_taken_out(standing.scenario.effects[k]))
      add_intervals_of_taken_out(standing.scenario, k, found);
  return found;
}

void SetBench::add_intervals_of_taken_out(const Scenario& scenario, std::size_t effect,
                                          std::vector<ParameterInterval>& to) const {
  constexpr double two_sided_95 = 1.959964;
  const Effect& middle = scenario.effects[effect];
  const auto& cause = cause_types().named(middle.id(), "effects");
  std::vector<std::size_t> fields;
  std::vector<double> steps;
  for (const auto name : cause.free_parameters) {
    fields.push_back(field_of(middle, name));
    steps.push_back(1e-3 * std::max(std::abs(middle.value(fields.back())), 1e-6));
  }
  const std::size_t n = fields.size();
  const auto likelihood = [&](const std::vector<double>& by) {
    Scenario there = scenario;
    for (std::size_t f = 0; f < n; ++f) there.effects[effect].value(fields[f]) += by[f] * steps[f];
    const auto fitter = fitter_of(there);
    return fitter ? fitter->terms(there).log_likelihood : -1e300;
  };
  const std::vector<double> nowhere(n, 0.0);
  const double here = likelihood(nowhere);
  // Steps to where the likelihood has changed enough to tell its curvature from rounding.
  for (std::size_t f = 0; f < n; ++f)
    for (int doubling = 0; doubling < 14; ++doubling) {
      auto by = nowhere;
      by[f] = 1.0;
      if (here - likelihood(by) > 0.1) break;
      steps[f] *= 2.0;
    }
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd curvature(size, size);
  tbb::parallel_for(std::size_t{0}, n * n, [&](std::size_t at) {
    const std::size_t a = at / n, b = at % n;
    if (a > b) return;
    const auto moved_by = [&](double of_a, double of_b) {
      auto by = nowhere;
      by[a] += of_a;
      by[b] += of_b;
      return likelihood(by);
    };
    const double second = a == b ? moved_by(0.5, 0.5) + moved_by(-0.5, -0.5) - 2.0 * here
                                 : 0.25 * (moved_by(1.0, 1.0) + moved_by(-1.0, -1.0) -
                                           moved_by(1.0, -1.0) - moved_by(-1.0, 1.0));
    const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
    curvature(i, j) = curvature(j, i) = -second;
  });
  const auto [covariance, pivots, positive] = invert_symmetric(curvature);
  if (!positive) return;
  for (std::size_t f = 0; f < n; ++f) {
    const auto i = static_cast<Eigen::Index>(f);
    const double value = middle.value(fields[f]);
    const double reach = two_sided_95 * steps[f] * std::sqrt(std::max(0.0, covariance(i, i)));
    to.push_back({effect, fields[f], value - reach, value + reach});
  }
}

}  // namespace gyrostat::gap
