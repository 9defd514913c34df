// The Allan variance of a Gauss-Markov process, and the slow errors that are read off it.

#include <gyrostat/diagnosis/gap/allan_components.hpp>

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/generators/effects/gauss_markov.hpp>
#include <gyrostat/generators/effects/telegraph.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {
namespace {

// Half the mean square difference of two neighbouring means of m points, of autocorrelation
// exp(-lag u / m): by its definition, but for (u / m)^2.
TEST(GaussMarkovAllanVariance, IsThatOfNeighbouringMeans) {
  constexpr int m = 20000;
  for (const double u : {1e-4, 0.9e-3, 1.1e-3, 0.01, 0.3, 1.0, 1.89, 10.0, 50.0}) {
    double sum = static_cast<double>(m);
    for (int lag = 1; lag < 2 * m; ++lag)
      sum += (lag < m ? 2.0 * m - 3.0 * lag : lag - 2.0 * m) * std::exp(-lag * u / m);
    EXPECT_NEAR(gauss_markov_allan_variance(u) * m * m / sum, 1.0, 2e-6 + u * u / m / m) << u;
  }
}

/// Median of what is found over recordings of twenty minutes.
double median_std(const Effect& effect) {
  std::vector<double> found;
  for (std::uint32_t trial = 0; trial < 15; ++trial) {
    Scenario s;
    s.sampling = {1200.0, 20.0};
    s.random_error = {
        .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.05};
    s.effects = {effect};
    Series series;
    synthesise(s, {41, trial}, series);
    series.rate_ref_dps.clear();
    series.temperature_C.clear();
    const Conditions conditions(series);
    found.push_back(fit_allan_components(conditions, Scene(conditions, series),
                                         SlowComponent::gauss_markov, false)
                        .slow_std_dps);
  }
  std::ranges::nth_element(found, found.begin() + 7);
  return found[7];
}

// One such recording holds eighty correlation times: a standard deviation of about 1 / sqrt(80) =
// 11 %, and that of a median of fifteen 1.25 * 11 % / sqrt(15) = 3.6 %. Five of them fail falsely
// at 6e-7; the formula without its factor 2 finds 41 % more.
TEST(AllanComponents, FindTheStandardDeviationOfAGaussMarkovProcess) {
  EXPECT_NEAR(median_std(effects::GaussMarkov{.std_dps = 0.03, .correlation_time_s = 15.0}) / 0.03,
              1.0, 0.18);
}

TEST(AllanComponents, FindTheAmplitudeOfATelegraphSignal) {
  EXPECT_NEAR(median_std(effects::Telegraph{.amplitude_dps = 0.03, .mean_dwell_s = 30.0}) / 0.03,
              1.0, 0.18);
}

}  // namespace
}  // namespace gyrostat::gap
