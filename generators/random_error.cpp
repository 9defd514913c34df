#include "generators/random_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gyrostat {
namespace {

/// Calls `use(sample, deviate)` for every sample, drawing a block at a time.
template <class Use>
void for_each_deviate(const NormalStream& stream, std::size_t count, const Use& use) {
  std::array<double, 256> block;
  for (std::size_t first = 0; first < count; first += block.size()) {
    const std::span<double> drawn(block.data(), std::min(block.size(), count - first));
    stream.fill(first, drawn);
    for (std::size_t i = 0; i < drawn.size(); ++i) use(first + i, drawn[i]);
  }
}

}  // namespace

void add_random_error(const Arima111<double>& model, const Noise& noise, std::span<double> x) {
  const double phi = model.phi, delta1 = model.delta1_dps, delta2 = model.delta2_dps;
  // What a_0 does not explain of the stationary first difference: all that came before it.
  const double unexplained = std::abs(phi * delta1 - delta2) / std::sqrt(1.0 - phi * phi);
  double level = 0.0, difference = 0.0, previous = 0.0;
  for_each_deviate(noise.stream("random_error"), x.size(), [&](std::size_t k, double a) {
    difference = k == 0 ? delta1 * a + unexplained * noise.stream("random_error/initial").normal(0)
                        : phi * difference + delta1 * a - delta2 * previous;
    previous = a;
    level += difference;
    x[k] += level;
  });
}

void add_white_noise(double std, const NormalStream& stream, std::span<double> values) {
  if (std == 0.0) return;
  for_each_deviate(stream, values.size(),
                   [&](std::size_t k, double deviate) { values[k] += std * deviate; });
}

}  // namespace gyrostat
