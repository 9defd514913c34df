#include <gyrostat/analysis/rare/common_direction.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace gyrostat {
namespace {

using Values = std::vector<double>;

double product(const Values& a, const Values& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Means over 2 reach + 1 samples, fewer at the ends.
Values smoothed(const Values& values, std::size_t reach) {
  if (reach == 0) return values;
  Values sums(values.size() + 1, 0.0);
  std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
  Values means(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t from = i > reach ? i - reach : 0;
    const std::size_t to = std::min(values.size(), i + reach + 1);
    means[i] = (sums[to] - sums[from]) / static_cast<double>(to - from);
  }
  return means;
}

/// A stream's part of the direction.
struct Part {
  Values values;
  double common = 0.0;   ///< its mean product with vectors that it was not made of
  double squared = 0.0;  ///< of its own length
  double gain() const { return common > 0.0 ? common * common / squared : 0.0; }
};

Part smoothed_part(std::span<const Values> vectors, const Values& mean, std::size_t reach) {
  const double n = static_cast<double>(vectors.size());
  Part part{smoothed(mean, reach), 0.0, 0.0};
  double own = 0.0;
  for (const auto& v : vectors) own += product(smoothed(v, reach), v);
  part.common = (n * n * product(part.values, mean) - own) / (n * (n - 1.0));
  part.squared = product(part.values, part.values);
  return part;
}

/// The best part of a stream, and in `raw` what its vectors have in common, squared.
Part best_part(std::span<const Values> vectors, double& raw) {
  Values mean(vectors.front().size(), 0.0);
  for (const auto& v : vectors)
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += v[i] / static_cast<double>(vectors.size());
  Part best = smoothed_part(vectors, mean, 0);
  raw = best.common;
  for (std::size_t reach = 1; reach < 2 * mean.size(); reach *= 2) {
    auto part = smoothed_part(vectors, mean, reach);
    if (part.gain() > best.gain()) best = std::move(part);
  }
  return best;
}

}  // namespace

std::optional<CommonDirection> common_direction(std::span<const NoiseTape> vectors) {
  assert(vectors.size() > 1);
  std::map<std::string, std::vector<Values>, std::less<>> streams;
  for (const auto& vector : vectors)
    for (const auto& [name, values] : vector) streams[name].push_back(values);
  CommonDirection direction;
  double gain = 0.0, length = 0.0;
  for (auto& [name, of_stream] : streams) {
    // What some trials alone have drawn, or not as much of, the others have as 0.
    of_stream.resize(vectors.size());
    std::size_t longest = 0;
    for (const auto& v : of_stream) longest = std::max(longest, v.size());
    if (longest == 0) continue;
    for (auto& v : of_stream) v.resize(longest, 0.0);
    double raw = 0.0;
    auto part = best_part(of_stream, raw);
    length += std::max(0.0, raw);
    if (part.gain() == 0.0) continue;
    gain += part.gain();
    for (double& v : part.values) v *= part.common / part.squared;
    direction.unit[name] = std::move(part.values);
  }
  if (!(gain > 0.0)) return std::nullopt;
  for (auto& [name, values] : direction.unit)
    for (double& v : values) v /= std::sqrt(gain);
  direction.closeness = length > gain ? std::sqrt(gain / length) : 1.0;
  return direction;
}

double along(const CommonDirection& direction, const Noise& noise, const Noise& at_place) {
  double sum = 0.0;
  Values drawn;
  for (const auto& [name, values] : direction.unit) {
    drawn.resize(values.size());
    const bool placed = !at_place.place.empty() && name.starts_with(at_place.place);
    const auto& from = placed ? at_place : noise;
    from.stream(std::string_view(name).substr(placed ? at_place.place.size() : 0)).fill(0, drawn);
    sum += product(drawn, values);
  }
  return sum;
}

}  // namespace gyrostat
