#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrostat {

/// Orthogonal wavelets of Daubechies with 1, 2 and 4 vanishing moments: Haar, D(4) and LA(8), the
/// last also known as symlet 4 (Daubechies, *Ten Lectures on Wavelets*, 1992, sec. 6.4 and 8.1).
enum class Wavelet { Haar, Daubechies4, LeastAsymmetric8 };

/// Scaling filter g of even width L: sum sqrt 2, orthonormal to its even shifts.
std::span<const double> scaling_filter(Wavelet wavelet);

/// Wavelet filter h_l = (-1)^l g_{L-1-l} (Percival & Walden, *Wavelet Methods for Time Series
/// Analysis*, 2000, eq. 75b).
std::vector<double> wavelet_filter(Wavelet wavelet);

enum class Transform { Decimated, Stationary };

/// Coefficients of a signal of `samples` values; level j = 1, 2, ... is detail[j - 1].
struct WaveletCoefficients {
  Wavelet wavelet;
  Transform transform;
  std::size_t samples;
  std::vector<std::vector<double>> detail;
  std::vector<double> smooth;
};

/// Discrete wavelet transform with a periodic boundary (Percival & Walden ch. 4): orthogonal, at
/// every length that is a multiple of 2^levels. Any other signal is first `reflected` up to the
/// next one, which the inverse takes off again.
///
/// Here and in modwt InputError is thrown for a sample that is missing or not finite, and for
/// levels outside [1, log2(samples)].
WaveletCoefficients dwt(std::span<const double> signal, Wavelet wavelet, std::size_t levels);

/// Maximal-overlap (stationary) discrete wavelet transform with a periodic boundary, at any length
/// (Percival & Walden ch. 5): as many coefficients at each level as samples; a shift of the
/// signal shifts them; the squares of all of them sum to those of the signal. White noise of
/// standard deviation s has coefficients of standard deviation s / 2^(j/2) at level j.
WaveletCoefficients modwt(std::span<const double> signal, Wavelet wavelet, std::size_t levels);

/// The signal whose dwt or modwt the coefficients are.
std::vector<double> inverse(const WaveletCoefficients& coefficients);

/// Most levels at which the widest filter, (2^levels - 1)(L - 1) + 1, still fits into `samples`.
std::size_t most_levels(Wavelet wavelet, std::size_t samples);

/// `length` values of the signal followed by its mirror image, the signal again, and so on.
std::vector<double> reflected(std::span<const double> signal, std::size_t length);

}  // namespace gyrostat
