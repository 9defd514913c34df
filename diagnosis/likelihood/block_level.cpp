#include <gyrostat/diagnosis/likelihood/block_level.hpp>

#include <algorithm>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {

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
  std::vector<double> means;
  for (const auto& [first, last] : blocks) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = first; i < last; ++i)
      if (!is_missing(values[i])) sum += values[i], count += 1.0;
    means.push_back(count > 0.0 ? sum / count : no_value);
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
