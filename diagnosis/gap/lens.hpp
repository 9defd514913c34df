#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/gap/scene.hpp>

namespace gyrostat::gap {

/// What stretch of its coordinate a reading stands for.
struct Interval {
  static constexpr double no_end = 1e9;  ///< "so much and more"

  double from, to;
  bool is_open() const { return to == no_end; }
};

/// A lens is bound to the conditions of a recording and one part of it, which fixes its `at`; it is
/// absent (`at` empty) where the recording does not hold what it looks at. `read(scene, out)`
/// writes one number for each interval.
struct Lens {
  Lens(const Conditions& seen, Part seen_part) : conditions(&seen), part(seen_part) {}

  const Conditions* conditions;
  Part part;
  std::vector<Interval> at;

  /// Smallest spread that a reading of this lens is credited with, for counts that may all be 0.
  static constexpr double least_spread = 0.0;

  const std::vector<Span>& spans() const { return conditions->spans(part); }
  const std::vector<Span>& slow_spans() const { return conditions->slow_spans(part); }
  /// Without the first sample of each span: those with a sample of the same part before them.
  std::vector<Span> later_spans() const {
    auto later = spans();
    for (auto& span : later) ++span.first;
    return later;
  }
  template <class PerPart>
  const auto& of(const PerPart& values) const {
    return values[index_of(part)];
  }
};

/// A power on a scale where its sampling error is even.
inline double level(double power) { return std::log(std::max(power, 1e-30)); }

/// Bins of some coordinate, and which bin every chosen index falls in.
class Bins {
 public:
  struct Entry {
    std::uint32_t index;
    std::uint32_t bin;
  };

  /// The indices of `spans` whose coordinate lies in one of `edges`' intervals; bins of fewer than
  /// `fewest` indices are left out.
  Bins(const std::vector<double>& coordinate, const std::vector<Span>& spans,
       const std::vector<double>& edges, std::size_t fewest);
  Bins() = default;

  const std::vector<Interval>& at() const { return at_; }
  const std::vector<Entry>& entries() const { return entries_; }

  /// Mean of `value(index)` over each bin into `out`, missing values passed over.
  template <class Value>
  void means(const Value& value, std::span<double> out) const {
    std::vector<double> sums(at_.size(), 0.0);
    std::vector<double> counts(at_.size(), 0.0);
    for (const auto [index, bin] : entries_) {
      const double v = value(index);
      if (is_missing(v)) continue;
      sums[bin] += v;
      counts[bin] += 1.0;
    }
    for (std::size_t b = 0; b < at_.size(); ++b)
      out[b] = counts[b] > 0.0 ? sums[b] / counts[b] : 0.0;
  }

 private:
  std::vector<Interval> at_;
  std::vector<Entry> entries_;
};

/// `count` + 1 edges that spread `values` at the indices of `spans` evenly over the bins.
std::vector<double> quantile_edges(const std::vector<double>& values,
                                   const std::vector<Span>& spans, std::size_t count);
/// Edges of the reference rate, dense about zero, where dead zones are.
std::vector<double> rate_edges(const std::vector<double>& rate_dps);
/// `count` + 1 equidistant edges from `low` to `high`.
std::vector<double> even_edges(double low, double high, std::size_t count);

}  // namespace gyrostat::gap
