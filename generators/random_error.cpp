#include <gyrostat/generators/random_error.hpp>

#include <cmath>

#include <gyrostat/generators/sampled.hpp>

namespace gyrostat {

double unexplained_difference_dps(const Arima111<double>& model) {
  return std::abs(model.phi * model.delta1_dps - model.delta2_dps) /
         std::sqrt(1.0 - model.phi * model.phi);
}

void add_random_error(const Arima111<double>& model, const Noise& noise, std::span<double> x) {
  const double phi = model.phi, delta1 = model.delta1_dps, delta2 = model.delta2_dps;
  if (delta1 == 0.0 && delta2 == 0.0) return;
  const double unexplained = unexplained_difference_dps(model);
  double level = 0.0, difference = 0.0, previous = 0.0;
  Deviates white(noise.stream("random_error"));
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double a = white.next();
    difference = k == 0 ? delta1 * a + unexplained * noise.stream("random_error/initial").normal(0)
                        : phi * difference + delta1 * a - delta2 * previous;
    previous = a;
    level += difference;
    x[k] += level;
  }
}

void add_white_noise(double std, const NormalStream& stream, std::span<double> values) {
  if (std == 0.0) return;
  Deviates white(stream);
  for (double& value : values) value += std * white.next();
}

}  // namespace gyrostat
