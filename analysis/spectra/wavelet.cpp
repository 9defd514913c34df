#include <gyrostat/analysis/spectra/wavelet.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr double half_root2 = 0.5 * std::numbers::sqrt2;
constexpr double root3 = std::numbers::sqrt3;

constexpr std::array haar_taps = {half_root2, half_root2};

constexpr std::array daubechies4 = {
    (1.0 + root3) / 4.0 * half_root2, (3.0 + root3) / 4.0 * half_root2,
    (3.0 - root3) / 4.0 * half_root2, (1.0 - root3) / 4.0 * half_root2};

/// The solution of the eight equations sum_l g_l g_{l+2k} = [k = 0] and sum_l (-1)^l l^k g_l = 0,
/// k = 0..3, that lies next to the table of Percival & Walden (p. 109), by Newton's method in 60
/// decimal digits. With the printed digits the shifts are orthogonal to 2e-13 only, and the error
/// of a reconstruction grows with the levels.
constexpr std::array least_asymmetric8 = {
    -0.075765714789502213, -0.029635527646002492, 0.49761866763277499,   0.80373875180513208,
    0.29785779560530605,   -0.099219543576633533, -0.012603967262031304, 0.032223100604051468};

/// One level of the pyramid: output t takes the inputs decimation * t + decimation - 1 - stride * l
/// with weights l of the filters. It is an isometry, so that its transpose undoes it.
struct Stage {
  std::vector<double> wavelet, scaling;
  std::size_t stride = 1, decimation = 2;

  Stage(Wavelet name, Transform transform, std::size_t level)
      : wavelet(wavelet_filter(name)),
        scaling(scaling_filter(name).begin(), scaling_filter(name).end()) {
    if (transform == Transform::Decimated) return;
    stride = std::size_t{1} << (level - 1);
    decimation = 1;
    for (std::size_t l = 0; l < wavelet.size(); ++l) {
      wavelet[l] *= half_root2;
      scaling[l] *= half_root2;
    }
  }

  template <class Visit>
  void for_each_tap(std::size_t inputs, std::size_t t, const Visit& visit) const {
    std::size_t at = decimation * t + decimation - 1;
    for (std::size_t l = 0; l < wavelet.size(); ++l) {
      visit(l, at);
      at = at >= stride ? at - stride : at + inputs - stride;
    }
  }

  /// Detail and smooth.
  std::pair<std::vector<double>, std::vector<double>> split(const std::vector<double>& in) const {
    std::vector<double> detail(in.size() / decimation), smooth(detail.size());
    for (std::size_t t = 0; t < detail.size(); ++t)
      for_each_tap(in.size(), t, [&](std::size_t l, std::size_t at) {
        detail[t] += wavelet[l] * in[at];
        smooth[t] += scaling[l] * in[at];
      });
    return {std::move(detail), std::move(smooth)};
  }

  std::vector<double> join(const std::vector<double>& detail,
                           const std::vector<double>& smooth) const {
    std::vector<double> out(detail.size() * decimation);
    for (std::size_t t = 0; t < detail.size(); ++t)
      for_each_tap(out.size(), t, [&](std::size_t l, std::size_t at) {
        out[at] += wavelet[l] * detail[t] + scaling[l] * smooth[t];
      });
    return out;
  }
};

WaveletCoefficients transformed(std::span<const double> signal, Wavelet wavelet,
                                Transform transform, std::size_t levels) {
  const std::size_t most = signal.empty() ? 0 : std::bit_width(signal.size()) - 1;
  if (levels < 1 || levels > most)
    throw InputError("levels", std::to_string(levels) + " is outside [1, " + std::to_string(most) +
                                   "] for " + std::to_string(signal.size()) + " samples");
  for (std::size_t i = 0; i < signal.size(); ++i)
    if (!std::isfinite(signal[i]))
      throw InputError("signal[" + std::to_string(i) + "]",
                       "is missing or not finite; fill the gap or pass a stretch without one");
  WaveletCoefficients out{wavelet, transform, signal.size(), {}, {}};
  const std::size_t block = transform == Transform::Decimated ? std::size_t{1} << levels : 1;
  out.smooth = reflected(signal, (signal.size() + block - 1) / block * block);
  for (std::size_t level = 1; level <= levels; ++level) {
    auto [detail, smooth] = Stage(wavelet, transform, level).split(out.smooth);
    out.detail.push_back(std::move(detail));
    out.smooth = std::move(smooth);
  }
  return out;
}

}  // namespace

std::span<const double> scaling_filter(Wavelet wavelet) {
  if (wavelet == Wavelet::Haar) return haar_taps;
  if (wavelet == Wavelet::Daubechies4) return daubechies4;
  return least_asymmetric8;
}

std::vector<double> wavelet_filter(Wavelet wavelet) {
  const auto scaling = scaling_filter(wavelet);
  std::vector<double> filter(scaling.rbegin(), scaling.rend());
  for (std::size_t l = 1; l < filter.size(); l += 2) filter[l] = -filter[l];
  return filter;
}

WaveletCoefficients dwt(std::span<const double> signal, Wavelet wavelet, std::size_t levels) {
  return transformed(signal, wavelet, Transform::Decimated, levels);
}

WaveletCoefficients modwt(std::span<const double> signal, Wavelet wavelet, std::size_t levels) {
  return transformed(signal, wavelet, Transform::Stationary, levels);
}

std::vector<double> inverse(const WaveletCoefficients& coefficients) {
  auto signal = coefficients.smooth;
  for (std::size_t level = coefficients.detail.size(); level > 0; --level)
    signal = Stage(coefficients.wavelet, coefficients.transform, level)
                 .join(coefficients.detail[level - 1], signal);
  signal.resize(coefficients.samples);
  return signal;
}

std::size_t most_levels(Wavelet wavelet, std::size_t samples) {
  const std::size_t reach = scaling_filter(wavelet).size() - 1;
  return samples == 0 ? 0 : std::bit_width((samples - 1) / reach + 1) - 1;
}

std::vector<double> reflected(std::span<const double> signal, std::size_t length) {
  const std::size_t n = signal.size();
  std::vector<double> out(length);
  for (std::size_t i = 0; i < length; ++i) {
    const std::size_t k = i % (2 * n);
    out[i] = signal[k < n ? k : 2 * n - 1 - k];
  }
  return out;
}

}  // namespace gyrostat
