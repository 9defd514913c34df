#include <gyrostat/analysis/spectra/welch.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include <unsupported/Eigen/FFT>

namespace gyrostat {

Spectrum welch(std::span<const std::span<const double>> stretches, double rate_hz,
               std::size_t length, std::size_t hop) {
  std::vector<double> window(length);
  double energy = 0.0;
  for (std::size_t i = 0; i < length; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                     static_cast<double>(length));
    energy += window[i] * window[i];
  }
  Spectrum spectrum{.resolution_hz = rate_hz / static_cast<double>(length), .density = {}};
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> segment(length);
  std::vector<std::complex<double>> transform;
  for (const auto& values : stretches) {
    for (std::size_t first = 0; first + length <= values.size(); first += hop) {
      const auto piece = values.subspan(first, length);
      const double mean =
          std::accumulate(piece.begin(), piece.end(), 0.0) / static_cast<double>(length);
      for (std::size_t i = 0; i < length; ++i) segment[i] = window[i] * (piece[i] - mean);
      fft.fwd(transform, segment);
      spectrum.density.resize(transform.size(), 0.0);
      for (std::size_t k = 0; k < transform.size(); ++k)
        spectrum.density[k] += std::norm(transform[k]);
      ++spectrum.segments;
    }
  }
  const double scale =
      2.0 / (rate_hz * energy * static_cast<double>(std::max<std::size_t>(1, spectrum.segments)));
  for (auto& value : spectrum.density) value *= scale;
  if (!spectrum.density.empty()) {
    spectrum.density.front() *= 0.5;
    spectrum.density.back() *= 0.5;
  }
  return spectrum;
}

}  // namespace gyrostat
