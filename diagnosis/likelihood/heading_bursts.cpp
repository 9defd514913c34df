#include <gyrostat/diagnosis/likelihood/heading_bursts.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_values = 50;  // values of which a spread is known

/// How far out values are, each as part of the run that is the farthest: the mean of a run beside
/// what means of that length are elsewhere, in standard deviations; 0 up to `far`.
std::vector<double> far_out(std::vector<double> values, const std::vector<Span>& spans, double far,
                            const std::vector<char>& misled) {
  std::vector<double> out(values.size(), 0.0);
  for (const std::size_t length : {1, 2, 4, 8, 16, 32}) {
    std::vector<double> means;
    std::vector<std::size_t> first;
    for (const auto& span : spans) {
      double sum = 0.0, count = 0.0;
      for (std::size_t i = span.first; i < span.last; ++i) {
        if (!is_missing(values[i])) sum += values[i], count += 1.0;
        if (i >= span.first + length && !is_missing(values[i - length]))
          sum -= values[i - length], count -= 1.0;
        if (i + 1 < span.first + length || 2.0 * count <= static_cast<double>(length)) continue;
        means.push_back(sum / count);
        first.push_back(i + 1 - length);
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i)
      if (misled[i] != 0) values[i] = no_value;
    if (means.size() < fewest_values) break;
    std::vector<double> sizes = means;
    for (double& size : sizes) size = std::abs(size);
    const double deviation = std::max(quantile(sizes, 0.5) / normal_quartile, 1e-9);
    const auto shorter = out;
    for (std::size_t k = 0; k < means.size(); ++k) {
      const double z = std::abs(means[k]) / deviation;
      const auto begin = static_cast<std::ptrdiff_t>(first[k]);
      const auto end = begin + static_cast<std::ptrdiff_t>(length);
      if (z <= std::max(far, *std::max_element(shorter.begin() + begin, shorter.begin() + end)))
        continue;
      for (auto at = out.begin() + begin; at != out.begin() + end; ++at) *at = std::max(*at, z);
    }
  }
  return out;
}

}  // namespace

HeadingBursts heading_bursts(const Conditions& conditions, std::vector<double> means_deg,
                             const std::vector<char>& misled) {
  HeadingBursts found{.hidden = std::vector<char>(means_deg.size(), 0)};
  constexpr double far = 5.0;
  const auto& spans = conditions.slow_spans(Part::train);
  std::vector<double> sizes;
  for (const auto& span : spans)
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(means_deg[i])) sizes.push_back(means_deg[i]);
  if (sizes.size() < fewest_values) return found;
  const double centre = quantile(sizes, 0.5);
  for (double& value : means_deg) value -= centre;
  for (double& s : sizes) s = std::abs(s - centre);
  const double deviation = std::max(quantile(sizes, 0.5) / normal_quartile, 1e-9);
  const auto out = far_out(means_deg, spans, far, misled);
  double hit = 0.0, bursts = 0.0, square = 0.0, count = 0.0;
  for (const auto& span : spans) {
    // Of a burst: each value for itself, or its farthest run.
    double each = 0.0, farthest = 0.0;
    const auto end_burst = [&] {
      if (farthest == 0.0) return;
      found.gain += std::max(each, 0.5 * farthest * farthest - std::log(farthest) - far);
      bursts += 1.0;
      each = farthest = 0.0;
    };
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (is_missing(means_deg[i])) continue;
      count += 1.0;
      if (out[i] == 0.0) {
        end_burst();
        continue;
      }
      found.hidden[i] = 1;
      const double z = std::abs(means_deg[i]) / deviation;
      hit += 1.0;
      square += z * z;
      farthest = std::max(farthest, out[i]);
      if (z > far) each += 0.5 * z * z - std::log(z) - far;
    }
    end_burst();
  }
  if (hit == 0.0) return found;
  found.per_hour = bursts / (count * conditions.slow_interval_s() / 3600.0);
  found.duration_s = std::max(hit / bursts, 1.0) * conditions.slow_interval_s();
  found.size_deg = deviation * std::sqrt(square / hit);
  return found;
}

}  // namespace gyrostat::gap
