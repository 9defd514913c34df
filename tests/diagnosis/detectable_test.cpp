// How large an effect must be to be found: against a law, and against what is found.

#include <gyrostat/diagnosis/likelihood/detectable.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/generators/effects/scale_factor.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::detectable_test {
namespace {

double no_least_gain(std::string_view /*effect*/) { return 0.0; }

std::vector<Detectable> detectable_in(const Scenario& scenario, bool moves) {
  const Series series = recorded(scenario, 4100, moves);
  const Simulator simulator(series, 1);
  const SetBench bench(simulator, series, {});
  return detectable_beside(bench, bench.beside_noise({}), no_least_gain);
}

const Detectable* of(std::string_view effect, const std::vector<Detectable>& all) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const auto& d) { return d.effect.id() == effect; });
  return at == all.end() ? nullptr : &*at;
}

/// In white noise the standard error of a scale factor is the noise over the root of the sum of
/// squared rates.
TEST(Detectable, OfAScaleFactorIsThatOfLeastSquares) {
  Scenario s = moving();
  s.random_error.delta1_dps = s.random_error.delta2_dps = 0.0;
  const Series series = recorded(s, 4100, true);
  const Simulator simulator(series, 1);
  const SetBench bench(simulator, series, {});
  const auto plain = bench.beside_noise({});
  const auto all = detectable_beside(bench, plain, no_least_gain);
  const auto* scale = of("scale_factor", all);
  ASSERT_NE(scale, nullptr);
  Scenario one = plain.scenario;
  one.effects.push_back(scale->effect);
  const auto with = bench.fitted(one, plain.fitter, 0);
  const double price = with.fit.log_likelihood - with.score;
  double squares = 0.0;
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      squares += series.rate_ref_dps[i] * series.rate_ref_dps[i];
  const double error = s.random_error.measurement_noise_std_dps / std::sqrt(squares);
  const double size = (std::sqrt(2.0 * price) + 0.8416) * error;
  EXPECT_NEAR(scale->effect.value(scale->field), size, 0.1 * size);
}

class Size : public testing::TestWithParam<std::string> {};

/// Of 24 recordings with an effect of that size fewer than 14 have it found once in 200 such tests,
/// were the chance 0.8; with half of the size it must be fewer than half.
TEST_P(Size, IsThatAtWhichTheEffectIsFound) {
  const auto all = detectable_in(still(), false);
  const auto* seen = of(GetParam(), all);
  ASSERT_NE(seen, nullptr);
  const auto& cause = cause_types().named(GetParam(), "test");
  constexpr std::size_t recordings = 24;
  const auto found = [&](double times) {
    std::size_t count = 0;
    for (std::uint64_t seed = 4200; seed < 4200 + recordings; ++seed) {
      Scenario s = still();
      s.effects = {seen->effect};
      s.effects.front().value(seen->field) *= times;
      const Series series = recorded(s, seed, false);
      const Simulator simulator(series, 1);
      const SetBench bench(simulator, series, {});
      const auto plain = bench.beside_noise({});
      if (bench.with(plain, cause, nullptr).score > plain.score) ++count;
    }
    return count;
  };
  EXPECT_GE(found(1.0), 14u);
  EXPECT_LT(found(0.5), recordings / 2);
}

INSTANTIATE_TEST_SUITE_P(Detectable, Size,
                         testing::Values("gauss_markov", "vibration", "rate_ramp",
                                         "thermal_curvature", "angle_quantization"),
                         [](const auto& effect) { return effect.param; });

}  // namespace
}  // namespace gyrostat::gap::detectable_test
