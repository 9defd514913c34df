#include <gyrostat/diagnosis/likelihood/noise_over.hpp>

#include <algorithm>
#include <cmath>

namespace gyrostat::gap {
namespace {

NoiseOver fitted(const std::vector<double>& off_C, const std::vector<double>& innovations,
                 double deviation, double cut, bool curved) {
  NoiseOver noise{deviation};
  constexpr int passes = 10;
  for (int pass = 0; pass < passes; ++pass) {
    // Of slope and curvature: information 2 x x^T and score (e^2 - 1) x, x the derivatives of the
    // logarithm of the size.
    double i11 = 0.0, i12 = 0.0, i22 = 0.0, s1 = 0.0, s2 = 0.0, squares = 0.0, count = 0.0;
    for (std::size_t k = 0; k < innovations.size(); ++k) {
      const double gain = noise.gain_at(off_C[k]);
      const double e = innovations[k] / (gain * noise.deviation);
      if (std::abs(e) > cut) continue;
      const double x1 = off_C[k] / gain, x2 = off_C[k] * x1, more = e * e - 1.0;
      i11 += 2.0 * x1 * x1;
      i12 += 2.0 * x1 * x2;
      i22 += 2.0 * x2 * x2;
      s1 += more * x1;
      s2 += more * x2;
      squares += e * e;
      count += 1.0;
    }
    noise.deviation *= std::sqrt(squares / std::max(1.0, count));
    const double determinant = i11 * i22 - i12 * i12;
    if (!(i11 > 0.0) || !(determinant > 0.0)) break;
    const double slope = curved ? (i22 * s1 - i12 * s2) / determinant : s1 / i11;
    const double curvature = curved ? (i11 * s2 - i12 * s1) / determinant : 0.0;
    constexpr double most = 0.05;  // a degree
    const double scale = std::min(1.0, most / std::max(std::abs(slope), 1e-300));
    noise.slope += scale * slope;
    noise.curvature += scale * curvature;
  }
  return noise;
}

/// Of the samples that are not far out to `judge`, their size being whatever is likeliest.
double log_likelihood(const NoiseOver& noise, const std::vector<double>& off_C,
                      const std::vector<double>& innovations, const NoiseOver& judge, double cut) {
  double squares = 0.0, logs = 0.0, count = 0.0;
  for (std::size_t k = 0; k < innovations.size(); ++k) {
    if (std::abs(innovations[k]) > cut * judge.deviation * judge.gain_at(off_C[k])) continue;
    const double gain = noise.gain_at(off_C[k]), e = innovations[k] / gain;
    count += 1.0;
    squares += e * e;
    logs += std::log(gain);
  }
  return -0.5 * count * std::log(squares / std::max(1.0, count)) - logs;
}

/// Variance of the squares of samples that are not far out, of that of normal noise: as much less
/// does each say of its size (McCullagh and Nelder, "Generalized Linear Models", 2nd ed., 4.5).
double dispersion(const NoiseOver& noise, const std::vector<double>& off_C,
                  const std::vector<double>& innovations, double cut) {
  double squares = 0.0, fourths = 0.0, count = 0.0;
  for (std::size_t k = 0; k < innovations.size(); ++k) {
    const double size = noise.deviation * noise.gain_at(off_C[k]);
    if (std::abs(innovations[k]) > cut * size) continue;
    const double square = std::pow(innovations[k] / size, 2);
    squares += square;
    fourths += square * square;
    count += 1.0;
  }
  return std::max(1.0, 0.5 * (fourths * count / std::max(squares * squares, 1e-300) - 1.0));
}

}  // namespace

double NoiseOver::gain_at(double off_C) const {
  return std::max(0.05, 1.0 + (slope + curvature * off_C) * off_C);
}

NoiseOver noise_over(const std::vector<double>& off_C, const std::vector<double>& innovations,
                     double deviation, double cut) {
  const auto gain = [&](const NoiseOver& more, const NoiseOver& less) {
    return (log_likelihood(more, off_C, innovations, more, cut) -
            log_likelihood(less, off_C, innovations, more, cut)) /
           dispersion(more, off_C, innovations, cut);
  };
  auto noise = fitted(off_C, innovations, deviation, cut, false);
  // Half the logarithm of the samples that a value costs, and what makes chance rare.
  constexpr double clear = 8.0;
  if (const auto curved = fitted(off_C, innovations, deviation, cut, true);
      gain(curved, noise) > clear)
    noise = curved;
  noise.gain = gain(noise, {deviation});
  return noise;
}

}  // namespace gyrostat::gap
