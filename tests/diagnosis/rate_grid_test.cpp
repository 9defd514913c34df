// What periodograms show of a density where samples do not count, against what they show.

#include <gyrostat/diagnosis/likelihood/rate_grid.hpp>

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/likelihood/reduced_rate.hpp>
#include <gyrostat/diagnosis/likelihood/set_fit.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::rate_grid_test {
namespace {

/// A share of the samples alone, and runs of five: the first are halfway between their neighbours,
/// the others zeros.
std::vector<char> hidden_in(std::size_t samples, double of_alone, double of_runs) {
  const NormalStream alone(3, 0, "alone"), runs(3, 0, "runs");
  std::vector<char> hidden(samples, 0);
  for (std::size_t i = 0; i < samples; ++i) {
    if (alone.uniform(i) < of_alone) hidden[i] = 1;
    if (runs.uniform(i) < of_runs)
      for (std::size_t k = i; k < std::min(i + 5, samples); ++k) hidden[k] = 1;
  }
  return hidden;
}

/// Bands of eight bins of forty recordings of filtered noise: a share of their ratio to the law has
/// a standard error of at most 0.7 % (sqrt(1.5 / (8 x 40 x 110 segments))); to five of them, which
/// one band in a million passes, come 3 % for the level that is taken out and for windows that
/// leak.
void expect_shown(const effects::NoiseBandwidth& filter, double alone, double runs) {
  Scenario s = still();
  s.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.05};
  s.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  s.effects = {filter};
  const Conditions conditions(recorded(s, 1, false));
  const auto grid = std::make_shared<const RateGrid>(
      conditions, hidden_in(conditions.series().size(), alone, runs));
  const auto law = grid->shown(density_of(law_of(s, conditions.interval_s()), grid->angles()));
  std::vector<double> seen(law.size(), 0.0);
  constexpr int recordings = 40;
  for (std::uint64_t seed = 1; seed <= recordings; ++seed) {
    const ReducedRate reduced(conditions, recorded(s, seed, false).gyro_dps, grid);
    for (std::size_t k = 0; k < seen.size(); ++k) seen[k] += reduced.periodogram()[k] / recordings;
  }
  constexpr std::size_t band = 8;
  for (std::size_t first = grid->first_fast_bin(); first + band < law.size(); first += band) {
    double ratio = 0.0;
    for (std::size_t k = first; k < first + band; ++k) ratio += seen[k] / law[k] / band;
    EXPECT_NEAR(ratio, 1.0, 5.0 * 0.007 + 0.03) << "from bin " << first;
  }
}

TEST(RateGrid, ShowsOfSmoothNoiseWhatPeriodogramsDo) {
  expect_shown({.cutoff_hz = 2.0, .poles = 2.0}, 0.05, 0.001);
}

/// Of whose density the last octave has a thousandth, and repeats alone are what is seen there.
TEST(RateGrid, ShowsOfSteepNoiseBesideRepeatsWhatPeriodogramsDo) {
  expect_shown({.cutoff_hz = 2.0, .poles = 2.0, .maximally_flat = 1.0}, 0.01, 0.0);
}

}  // namespace
}  // namespace gyrostat::gap::rate_grid_test
