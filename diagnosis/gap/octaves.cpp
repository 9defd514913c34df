#include <gyrostat/diagnosis/gap/octaves.hpp>

#include <algorithm>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

std::size_t differences(std::span<const Span> spans, std::size_t cluster) {
  std::size_t count = 0;
  for (const auto& span : spans) count += std::max<std::size_t>(1, span.size() / cluster) - 1;
  return count;
}

}  // namespace

std::size_t octave_count(std::span<const Span> spans, std::size_t fewest) {
  std::size_t octaves = 0;
  while (differences(spans, std::size_t{1} << octaves) >= fewest) ++octaves;
  return octaves;
}

std::vector<Octave> octaves(const std::vector<double>& values, std::span<const Span> spans,
                            std::size_t fewest) {
  const std::size_t levels = octave_count(spans, fewest);
  std::vector<Octave> result(levels);
  struct Sums {
    double square = 0, fourth = 0, peak = 0, level = 0, level_square = 0, level_fourth = 0;
  };
  std::vector<Sums> sums(levels);
  std::vector<double> means;
  for (const auto& span : spans) {
    means.assign(values.begin() + static_cast<std::ptrdiff_t>(span.first),
                 values.begin() + static_cast<std::ptrdiff_t>(span.last));
    double centre = 0.0;
    std::size_t present = 0;
    for (const double v : means)
      if (!is_missing(v)) {
        centre += v;
        ++present;
      }
    centre /= static_cast<double>(std::max<std::size_t>(present, 1));
    for (std::size_t level = 0; level < levels && means.size() > 1; ++level) {
      auto at = sums[level];
      std::size_t count = 0;
      double level_square = 0.0, level_fourth = 0.0;
      for (std::size_t i = 0; i < means.size(); ++i) {
        const double d = means[i] - centre;
        if (is_missing(d)) continue;
        level_square += d * d;
        level_fourth += d * d * d * d;
        if (i + 1 == means.size() || is_missing(means[i + 1])) continue;
        const double step = means[i + 1] - means[i];
        const double square = step * step;
        at.square += square;
        at.fourth += square * square;
        at.peak = std::max(at.peak, square);
        ++count;
      }
      at.level += static_cast<double>(means.size());
      at.level_square += level_square;
      at.level_fourth += level_fourth;
      sums[level] = at;
      result[level].count += count;
      for (std::size_t i = 0; i + 1 < means.size(); i += 2)
        means[i / 2] = 0.5 * (means[i] + means[i + 1]);
      means.resize(means.size() / 2);
    }
  }
  for (std::size_t level = 0; level < levels; ++level) {
    auto& octave = result[level];
    const auto& at = sums[level];
    octave.cluster = std::size_t{1} << level;
    const auto count = static_cast<double>(octave.count);
    if (at.square > 0.0) {
      octave.mean_square = at.square / count;
      octave.kurtosis = at.fourth / count / (octave.mean_square * octave.mean_square);
      octave.peak = at.peak / octave.mean_square;
    }
    if (at.level_square > 0.0)
      octave.level_kurtosis = at.level * at.level_fourth / (at.level_square * at.level_square);
  }
  return result;
}

}  // namespace gyrostat::gap
