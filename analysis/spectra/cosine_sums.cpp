#include <gyrostat/analysis/spectra/cosine_sums.hpp>

#include <complex>

#include <unsupported/Eigen/FFT>

namespace gyrostat {

std::vector<double> cosine_sums(const std::vector<double>& values) {
  // It keeps the roots of unity of each length, which take longer than the transform.
  static thread_local Eigen::FFT<double> fft = [] {
    Eigen::FFT<double> half;
    half.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    return half;
  }();
  const std::size_t n = values.size() - 1;
  std::vector<double> period(values);
  period.resize(2 * n);
  for (std::size_t k = 1; k < n; ++k) period[2 * n - k] = values[k];
  std::vector<std::complex<double>> transform;
  fft.fwd(transform, period);
  std::vector<double> sums(n + 1);
  for (std::size_t k = 0; k <= n; ++k) sums[k] = transform[k].real();
  return sums;
}

}  // namespace gyrostat
