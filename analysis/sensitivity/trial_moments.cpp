#include <gyrostat/analysis/sensitivity/trial_moments.hpp>

#include <cmath>
#include <numbers>

namespace gyrostat {
namespace {

TrialMean moments(double sum, double squares, double count) {
  const double mean = sum / count;
  if (count < 2.0) return {mean, 0.0};
  return {mean, std::max(0.0, squares / count - mean * mean) / (count - 1.0)};
}

}  // namespace

double TrialMean::excess() const {
  const double error = std::sqrt(variance);
  if (error == 0.0) return 0.0;
  const double z = std::abs(mean) / error;
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  return error * (2.0 * density - z * std::erfc(z / std::numbers::sqrt2));
}

std::vector<TrialMean> trial_means(std::span<const double> values) {
  double centre = 0.0, count = 0.0;
  for (const double v : values)
    if (!std::isnan(v)) {
      centre += v;
      count += 1.0;
    }
  std::vector<TrialMean> means(values.size() + 1);
  if (count == 0.0) return means;
  centre /= count;
  double squares = 0.0;  // about the centre
  for (const double v : values)
    if (!std::isnan(v)) squares += (v - centre) * (v - centre);
  const auto shifted = [&](double sum, double rest, double n) {
    auto m = moments(sum, rest, n);
    m.mean += centre;
    return m;
  };
  means[0] = shifted(0.0, squares, count);
  for (std::size_t t = 0; t < values.size(); ++t) {
    const double d = values[t] - centre;
    means[t + 1] =
        std::isnan(d) || count < 2.0 ? means[0] : shifted(-d, squares - d * d, count - 1.0);
  }
  // One of two trials has no spread of its own; it has that of both.
  for (std::size_t t = 0; count == 2.0 && t < values.size(); ++t)
    if (!std::isnan(values[t])) means[t + 1].variance = 2.0 * means[0].variance;
  return means;
}

}  // namespace gyrostat
