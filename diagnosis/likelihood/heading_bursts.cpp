#include <gyrostat/diagnosis/likelihood/heading_bursts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_values = 50;  // values of which a spread is known
constexpr std::size_t fewest_runs = 10;    // and of runs beside one another

struct Interval {
  double centre, half_length;
};

/// The shortest that holds half of the values, of which bursts are few (Rousseeuw and Leroy,
/// "Robust Regression and Outlier Detection", 1987, 4.2).
Interval shortest_half(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = (values.size() - 1) / 2;
  std::size_t first = 0;
  for (std::size_t i = 0; i + half < values.size(); ++i)
    if (values[i + half] - values[i] < values[first + half] - values[first]) first = i;
  return {0.5 * (values[first] + values[first + half]),
          0.5 * (values[first + half] - values[first])};
}

/// Means of all runs of one length: of each where it begins, and whether it counts for how far such
/// means are usually out.
struct Runs {
  std::vector<double> means;
  std::vector<std::size_t> first;
  std::vector<double> usual;  ///< means of runs in which nothing is hidden

  Runs(const std::vector<double>& values, const std::vector<Span>& spans, std::size_t length,
       const std::vector<char>& hidden) {
    for (const auto& span : spans) {
      double sum = 0.0, count = 0.0, far = 0.0;
      for (std::size_t i = span.first; i < span.last; ++i) {
        const auto enter = [&](std::size_t k, double sign) {
          if (is_missing(values[k])) return;
          sum += sign * values[k];
          count += sign;
          far += hidden[k] != 0 ? sign : 0.0;
        };
        enter(i, 1.0);
        if (i >= span.first + length) enter(i - length, -1.0);
        if (i + 1 < span.first + length || 2.0 * count <= static_cast<double>(length)) continue;
        means.push_back(sum / count);
        first.push_back(i + 1 - length);
        if (far < 0.5) usual.push_back(means.back());
      }
    }
  }
};

/// How far out values are, each as part of the run that is the farthest: the mean of a run beside
/// what means of that length are elsewhere, in standard deviations; 0 up to `far`.
std::vector<double> far_out(std::vector<double> values, const std::vector<Span>& spans, double far,
                            const std::vector<char>& misled, const std::vector<char>& hidden) {
  std::vector<double> out(values.size(), 0.0), steps;
  for (const auto& span : spans)
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      if (const double step = std::abs(values[i] - values[i - 1]); !is_missing(step))
        steps.push_back(step);
  if (steps.size() < fewest_values) return out;
  const double white = quantile(std::move(steps), 0.5) / (std::numbers::sqrt2 * normal_quartile);
  for (const std::size_t length : {1, 2, 4, 8, 16, 32, 64}) {
    const Runs runs(values, spans, length, hidden);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (misled[i] != 0) values[i] = no_value;
    if (runs.usual.size() < std::max(fewest_values, fewest_runs * length)) break;
    const auto [centre, half_length] = shortest_half(runs.usual);
    const double deviation = std::max(
        {half_length / normal_quartile, white / std::sqrt(static_cast<double>(length)), 1e-9});
    const auto shorter = out;
    for (std::size_t k = 0; k < runs.means.size(); ++k) {
      const double z = std::abs(runs.means[k] - centre) / deviation;
      const auto begin = static_cast<std::ptrdiff_t>(runs.first[k]);
      const auto end = begin + static_cast<std::ptrdiff_t>(length);
      if (z <= std::max(far, *std::max_element(shorter.begin() + begin, shorter.begin() + end)))
        continue;
      for (auto at = out.begin() + begin; at != out.begin() + end; ++at) *at = std::max(*at, z);
    }
  }
  return out;
}

/// Those of `misled` where errors are larger than elsewhere; none where they are not.
std::vector<char> where_larger(const std::vector<double>& values, const std::vector<Span>& spans,
                               const std::vector<char>& misled) {
  std::array<std::vector<double>, 2> sizes;
  for (const auto& span : spans)
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(values[i])) sizes[misled[i] != 0 ? 1 : 0].push_back(std::abs(values[i]));
  constexpr double no_larger = 1.1;
  if (std::min(sizes[0].size(), sizes[1].size()) < fewest_values ||
      quantile(sizes[1], 0.5) > no_larger * quantile(sizes[0], 0.5))
    return misled;
  return std::vector<char>(misled.size(), 0);
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
  const auto larger = where_larger(means_deg, spans, misled);
  // Beside bursts, what means usually are is smaller.
  std::vector<char> hidden(means_deg.size(), 0);
  std::vector<double> out;
  constexpr int passes = 3;
  for (int pass = 0; pass < passes; ++pass) {
    out = far_out(means_deg, spans, far, larger, hidden);
    for (std::size_t i = 0; i < out.size(); ++i) hidden[i] = out[i] > 0.0 ? 1 : 0;
  }
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
