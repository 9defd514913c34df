#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/core/table.hpp>

namespace gyrostat::gap {

/// Hits among so many, with their 95 % Wilson interval.
struct Share {
  double hits = 0, count = 0;

  void add(bool hit) {
    hits += hit ? 1.0 : 0.0;
    count += 1.0;
  }
  Share& operator+=(const Share& other) {
    hits += other.hits;
    count += other.count;
    return *this;
  }
  TableCell percent() const;
  TableCell bound(bool upper) const;
  TableCell text() const;   ///< "90 % (9 of 10; 60 to 98)"
  TableCell plain() const;  ///< "9 of 10"
};

/// A statistic of recordings with its 95 % bootstrap interval, whole recordings being drawn:
/// effects of one are found or missed together. The statistic is given the recordings' indices; NaN
/// where it has no value. As text "0.82 (0.71 to 0.90)", empty where there is no value.
TableCell bootstrapped(std::size_t recordings,
                       const std::function<double(std::span<const std::size_t>)>& statistic);

/// The same of the median of values.
TableCell bootstrapped_median(const std::vector<double>& values);

}  // namespace gyrostat::gap
