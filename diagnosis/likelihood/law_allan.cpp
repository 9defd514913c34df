#include <gyrostat/diagnosis/likelihood/law_allan.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace gyrostat::gap {
namespace {

/// Of the stationary process with this autocovariance, asked for at the lags 0, 1, 2, …
template <class Autocovariance>
double of_autocovariance(std::size_t cluster, Autocovariance&& next) {
  const auto m = static_cast<double>(cluster);
  double sum = m * next();
  for (std::size_t lag = 1; lag < 2 * cluster; ++lag) {
    const auto k = static_cast<double>(lag);
    sum += (lag < cluster ? 2.0 * m - 3.0 * k : k - 2.0 * m) * next();
  }
  return std::max(0.0, sum) / (m * m);
}

/// Of unit white noise that has passed the law's filter and its averaging.
double of_filtered_white(const NoiseLaw& law, std::size_t cluster) {
  const auto m = static_cast<double>(cluster);
  constexpr std::size_t longest = 4096;
  if ((!law.filter && law.averaging.empty()) || cluster > longest) return 1.0 / m;
  static const Angles angles(65537);
  const auto gain = gain_of_white(law, angles);
  const std::size_t last = gain.size() - 1;
  double sum = 0.0;
  for (std::size_t k = 1; k <= last; ++k) {
    const double angle = angles.values[k];
    const double sine = std::sin(0.5 * m * angle);
    const double window = sine * sine / (m * std::sin(0.5 * angle));
    sum += (k == last ? 1.0 : 2.0) * gain[k] * window * window;
  }
  return sum / static_cast<double>(last);
}

/// Of a walk whose steps have unit variance.
double of_walk(std::size_t cluster) {
  const auto m = static_cast<double>(cluster);
  return (2.0 * m * m + 1.0) / (6.0 * m);
}

}  // namespace

double allan_variance(const NoiseLaw& given, std::size_t cluster) {
  const NoiseLaw law = given.without_jumps();
  const auto m = static_cast<double>(cluster);
  double variance = law.rounding / m + law.walk * law.interval_s * of_walk(cluster);
  if (law.white > 0.0) variance += law.white * of_filtered_white(law, cluster);
  variance += 1.5 * law.angle / (m * m);
  for (const auto& d : law.decaying) {
    const double a = std::exp(-law.interval_s / d.memory_s);
    double c = d.variance;
    variance += of_autocovariance(cluster, [&] {
      const double now = c;
      c *= a;
      return now;
    });
  }
  for (const auto& r : law.resonances) {
    const auto turn = std::polar(std::exp(-std::numbers::pi * r.bandwidth_hz * law.interval_s),
                                 2.0 * std::numbers::pi * r.centre_hz * law.interval_s);
    std::complex<double> c = r.variance;
    variance += of_autocovariance(cluster, [&] {
      const double now = c.real();
      c *= turn;
      return now;
    });
  }
  for (const auto& line : law.wandering) {
    const auto turn = std::polar(1.0, 2.0 * std::numbers::pi * line.frequency_hz * law.interval_s);
    std::complex<double> c = 0.5 * line.amplitude_dps * line.amplitude_dps;
    double lag = 0.0;
    variance += of_autocovariance(cluster, [&] {
      const double now = c.real() * line.coherence(lag++ * law.interval_s);
      c *= turn;
      return now;
    });
  }
  return variance;
}

}  // namespace gyrostat::gap
