#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <gyrostat/analysis/spectra/wavelet.hpp>

namespace gyrostat {

/// Soft moves a coefficient by the threshold towards 0 and stops there; hard keeps or drops it.
enum class ThresholdRule { Soft, Hard };

/// Donoho & Johnstone, *Ideal spatial adaptation by wavelet shrinkage*, Biometrika 81 (1994).
double thresholded(double coefficient, double threshold, ThresholdRule rule);

/// Standard deviation of white noise in the signal: median |w| / 0.6745 over the finest level,
/// whose coefficients hardly know the signal; a modwt's are scaled up by sqrt 2. It is 0 where more
/// than half of them are 0, as when a resolution coarser than the noise has rounded it away.
double noise_std(const WaveletCoefficients& coefficients);

/// sqrt(2 log n), n coefficients to be judged: the `samples` of a decimated transform (Donoho &
/// Johnstone), samples times levels of a stationary one (the n log2 n of Coifman & Donoho where the
/// levels are all there are). White noise of unit standard deviation alone passes it anywhere with
/// a probability below 1 / sqrt(pi log n); an estimated standard deviation adds a little to that.
double universal_threshold(const WaveletCoefficients& coefficients);

/// Applies the rule to all details. `threshold` is that of a coefficient of unit norm: level j of a
/// stationary transform, where the noise is 2^(j/2) times smaller, takes threshold / 2^(j/2).
void shrink(WaveletCoefficients& coefficients, double threshold, ThresholdRule rule);

/// Stationary and hard is Coifman & Donoho's choice; on steps, exponentials, sines and random walks
/// no other was clearly better with the same wavelet. LA(8) suits a drift, Haar a step.
struct ShrinkageOptions {
  Wavelet wavelet = Wavelet::LeastAsymmetric8;
  Transform transform = Transform::Stationary;
  ThresholdRule rule = ThresholdRule::Hard;
  std::size_t levels = 0;  ///< 0: the most that fit
};

struct ShrunkRate {
  std::vector<double> rate;
  double noise_std;  ///< of the raw rate, in its unit
  double threshold;  ///< noise_std times the universal threshold
  std::size_t levels;
};

/// The rate without its white noise, by wavelet shrinkage at the universal threshold: Donoho &
/// Johnstone (1994) on the decimated transform; on the stationary one the translation-invariant
/// form of Coifman & Donoho (*Translation-invariant de-noising*, Lecture Notes in Statistics 103,
/// 1995), which is the mean over all shifts of the decimated form and makes fewer artefacts.
///
/// The rate is mirrored at its ends, so that a drift does not jump where the period closes. What is
/// slower than white noise (a random walk, a thermal drift) counts as signal and is kept as far as
/// it stands above the threshold. Throws InputError for a sample that is missing or not finite, and
/// for levels outside [1, most_levels].
ShrunkRate shrink_rate(std::span<const double> rate, const ShrinkageOptions& options = {});

}  // namespace gyrostat
