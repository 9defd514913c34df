// The p-value of a gap where there is none.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/diagnosis/gap/ensemble.hpp>
#include <gyrostat/diagnosis/model_fit.hpp>
#include <gyrostat/diagnosis/simulator.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::gap_p_value_test {
namespace {

/// p-values of 500 recordings of 40 s that the simulator made itself, known or fitted to each of
/// them.
std::vector<double> own_p_values(bool fitted) {
  Scenario s;
  s.sampling = {40.0, 50.0};
  s.random_error = {
      .phi = 0.5, .delta1_dps = 2e-3, .delta2_dps = 5e-4, .measurement_noise_std_dps = 0.05};
  std::vector<double> p;
  for (std::uint64_t k = 0; k < 500; ++k) {
    const Series series = recorded(s, 1000 + k, false);
    const Simulator simulator(series, k);
    BaselineFit fit{.scenario = s, .train_jacobian = {}};
    if (fitted) fit = fit_baseline(simulator, series);
    const Ensemble ensemble(simulator.instrument(Part::train),
                            simulator.ensemble(fit.scenario, 0, 80)[0], fit.train_jacobian);
    p.push_back(ensemble.p_value(simulator.readings(series)[0]));
  }
  std::sort(p.begin(), p.end());
  return p;
}

// Kolmogorov-Smirnov at n = 500: sqrt(n) D exceeds 1.95 with probability 0.001 where p is uniform.
// p is on a grid of 1 / 81 above the replicas' own, which adds 0.0124 sqrt(500) = 0.28 at most. A
// false alarm rate of 5 % has a standard error of 1 %; four of them are passed once in 30,000.
void expect_uniform(const std::vector<double>& p) {
  double distance = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    distance = std::max({distance, p[i] - static_cast<double>(i) / 500.0,
                         static_cast<double>(i + 1) / 500.0 - p[i]});
  EXPECT_LT(std::sqrt(500.0) * distance, 1.95 + 0.28);
  const auto alarms = std::upper_bound(p.begin(), p.end(), 0.05) - p.begin();
  EXPECT_LT(static_cast<double>(alarms) / 500.0, 0.05 + 4.0 * 0.01);
}

TEST(Gap, ThePValueOfTheKnownSimulatorsOwnRecordingsIsUniform) {
  expect_uniform(own_p_values(false));
}

TEST(Gap, ThePValueOfTheFittedSimulatorsOwnRecordingsIsUniform) {
  expect_uniform(own_p_values(true));
}

}  // namespace
}  // namespace gyrostat::gap::gap_p_value_test
