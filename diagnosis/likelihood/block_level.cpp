#include <gyrostat/diagnosis/likelihood/block_level.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// The mean, of a few that lie beyond `gross` of their median without them: of a block one reading
/// at the end of a sensor's range would be all of its level.
double level_of(std::vector<double> values, double gross) {
  const auto mean = [&] {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return values.empty() ? no_value : sum / static_cast<double>(values.size());
  };
  if (values.empty()) return no_value;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*high - *low <= gross) return mean();
  const double median = quantile(values, 0.5);
  const auto is_gross = [&](double v) { return std::abs(v - median) > gross; };
  constexpr std::size_t one_in = 8;
  const auto count = std::count_if(values.begin(), values.end(), is_gross);
  if (one_in * static_cast<std::size_t>(count) <= values.size()) std::erase_if(values, is_gross);
  return mean();
}

/// Standard deviation of what changes from one value to the next, robustly.
double deviation_of_steps(const std::vector<Span>& blocks, const std::vector<double>& values) {
  std::vector<double> steps;
  for (const auto& [first, last] : blocks)
    for (std::size_t i = first + 1; i < last; ++i)
      if (const double step = values[i] - values[i - 1]; !is_missing(step))
        steps.push_back(std::abs(step));
  return quantile(std::move(steps), 0.5) / (std::numbers::sqrt2 * normal_quartile);
}

}  // namespace

std::vector<Span> level_blocks(const Conditions& conditions) {
  // Long enough not to follow single samples.
  const std::size_t block = std::max<std::size_t>(conditions.cluster(), 32);
  std::vector<Span> blocks;
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part))
      for (std::size_t first = span.first; first < span.last; first += block)
        blocks.push_back({first, std::min(first + block, span.last)});
  return blocks;
}

void take_out_level(const Conditions& conditions, std::vector<double>& values) {
  const auto blocks = level_blocks(conditions);
  constexpr double deviations = 50.0;
  const double gross = deviations * deviation_of_steps(blocks, values);
  std::vector<double> means;
  for (const auto& [first, last] : blocks) {
    std::vector<double> present;
    for (std::size_t i = first; i < last; ++i)
      if (!is_missing(values[i])) present.push_back(values[i]);
    means.push_back(level_of(std::move(present), gross));
  }
  const auto middle = [&](std::size_t block) {
    return 0.5 * static_cast<double>(blocks[block].first + blocks[block].last - 1);
  };
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t i = blocks[b].first; i < blocks[b].last; ++i) {
      const double from_middle = static_cast<double>(i) - middle(b);
      const std::size_t other = from_middle < 0.0 ? b - 1 : b + 1;
      double level = means[b];
      const bool is_beside = other < blocks.size() && !is_missing(means[other]) &&
                             (other > b ? blocks[b].last == blocks[other].first
                                        : blocks[other].last == blocks[b].first);
      if (is_beside) level += (means[other] - means[b]) * from_middle / (middle(other) - middle(b));
      values[i] -= level;
    }
}

}  // namespace gyrostat::gap
