#include <gyrostat/generators/between_changes.hpp>

#include <algorithm>
#include <cmath>

namespace gyrostat {
namespace {

class Sums {
 public:
  explicit Sums(std::span<const double> values) : total_(values.size() + 1, 0.0) {
    for (std::size_t i = 0; i < values.size(); ++i) total_[i + 1] = total_[i] + values[i];
  }
  double over(std::size_t from, std::size_t to) const { return total_[to] - total_[from]; }
  double mean(std::size_t from, std::size_t to) const {
    return over(from, to) / static_cast<double>(to - from);
  }

 private:
  std::vector<double> total_;
};

/// Of the noise about a level that seldom changes; the median of a squared difference is 0.91 of
/// it.
double variance_of_noise(std::span<const double> values) {
  std::vector<double> squares;
  for (std::size_t i = 1; i < values.size(); ++i)
    squares.push_back((values[i] - values[i - 1]) * (values[i] - values[i - 1]));
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::max(*middle / 0.91, 1e-12);
}

/// Where the level changes, from 0 to the end.
std::vector<std::size_t> edges_of(std::span<const double> values) {
  std::vector<double> squares;
  for (const double v : values) squares.push_back(v * v);
  const Sums sum(values), square(squares);
  const double price =
      6.0 * std::log(static_cast<double>(values.size())) * variance_of_noise(values);
  std::vector<double> cost(values.size() + 1, 0.0);
  std::vector<std::size_t> start(values.size() + 1, 0);
  for (std::size_t to = 1; to <= values.size(); ++to) {
    cost[to] = 1e300;
    for (std::size_t from = 0; from < to; ++from) {
      const double total = sum.over(from, to);
      const double with = cost[from] + price + square.over(from, to) -
                          total * total / static_cast<double>(to - from);
      if (with < cost[to]) cost[to] = with, start[to] = from;
    }
  }
  std::vector<std::size_t> edges = {values.size()};
  while (edges.back() > 0) edges.push_back(start[edges.back()]);
  std::ranges::reverse(edges);
  return edges;
}

/// The sample from `first` to `last` at which squares of normal values change their mean.
std::size_t likeliest_edge(std::span<const double> squares, std::size_t first, std::size_t last,
                           double left, double right) {
  double gain = 0.0, most = 0.0;
  std::size_t edge = first;
  for (std::size_t i = first; i < last; ++i) {
    gain += squares[i] * (1.0 / right - 1.0 / left) + std::log(right / left);
    if (gain > most) most = gain, edge = i + 1;
  }
  return edge;
}

}  // namespace

std::vector<double> between_changes(std::span<const double> strength, std::size_t block) {
  const std::size_t blocks = strength.size() / block;
  if (blocks < 3) return {strength.begin(), strength.end()};
  const Sums sums(strength);
  const double least = 1e-9 * sums.mean(0, strength.size());
  if (!(least > 0.0)) return {strength.begin(), strength.end()};

  std::vector<double> logs;
  for (std::size_t b = 0; b < blocks; ++b)
    logs.push_back(std::log(sums.mean(b * block, (b + 1) * block) + least));
  auto edges = edges_of(logs);
  for (std::size_t& edge : edges) edge *= block;
  edges.back() = strength.size();
  for (std::size_t e = 1; e + 1 < edges.size(); ++e)
    edges[e] = likeliest_edge(strength, std::max(edges[e] - block, edges[e - 1] + 1),
                              std::min(edges[e] + block, edges[e + 1] - 1),
                              sums.mean(edges[e - 1], edges[e]) + least,
                              sums.mean(edges[e], edges[e + 1]) + least);

  std::vector<double> means;
  for (std::size_t e = 1; e < edges.size(); ++e)
    means.resize(edges[e], sums.mean(edges[e - 1], edges[e]));
  return means;
}

}  // namespace gyrostat
