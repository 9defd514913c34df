// What a law is expected to gain on another, against the covariance of all samples.

#include <gyrostat/diagnosis/likelihood/law_gain.hpp>

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::law_gain_test {
namespace {

constexpr double interval_s = 0.05, white = 2.5e-3;
constexpr Eigen::Index samples = 1000;

/// Of normal samples with that autocovariance, against white noise of their variance: the
/// divergence of Kullback and Leibler (1951), half of N log of the variance less log det.
template <class Covariance>
double divergence(const Covariance& covariance) {
  Eigen::MatrixXd all(samples, samples);
  for (Eigen::Index i = 0; i < samples; ++i)
    for (Eigen::Index j = 0; j < samples; ++j)
      all(i, j) =
          covariance(std::abs(static_cast<double>(i - j)) * interval_s) + (i == j ? white : 0.0);
  const double variance = all(0, 0);
  const Eigen::LLT<Eigen::MatrixXd> root(all);
  return 0.5 * static_cast<double>(samples) * std::log(variance) -
         root.matrixLLT().diagonal().array().log().sum();
}

class LawGain : public testing::Test {
 protected:
  LawGain() {
    Scenario s = still();
    s.sampling = {1200.0, 1.0 / interval_s};
    series_ = recorded(s, 4300, false);
  }
  Gain gain(const NoiseLaw& truth, const NoiseLaw& rival) const {
    const Conditions conditions(series_);
    const RateGrid grid(conditions, std::vector<char>(series_.size(), 0));
    return gain_over(truth, rival, grid, static_cast<double>(samples), 0.0);
  }
  NoiseLaw noise_{.interval_s = interval_s,
                  .duration_s = interval_s * static_cast<double>(samples),
                  .white = white};

 private:
  Series series_;
};

TEST_F(LawGain, OfAWanderingLineIsTheDivergenceOfAllSamples) {
  for (const double frequency_hz : {2.5, 7.0}) {
    const effects::WanderingLine line{0.04, frequency_hz, 0.3, 0.8};
    NoiseLaw truth = noise_;
    truth.wandering.push_back(line);
    const double exact = divergence([&](double lag_s) {
      return 0.5 * line.amplitude_dps * line.amplitude_dps *
             std::cos(2.0 * std::numbers::pi * frequency_hz * lag_s) * line.coherence(lag_s);
    });
    EXPECT_NEAR(gain(truth, noise_).mean, exact, 0.1 * exact) << frequency_hz;
  }
}

TEST_F(LawGain, OfTheSameLawIsNothing) { EXPECT_NEAR(gain(noise_, noise_).mean, 0.0, 1e-6); }

}  // namespace
}  // namespace gyrostat::gap::law_gain_test
