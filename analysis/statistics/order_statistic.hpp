#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gyrostat {

/// The value of a given rank among values that come by again and again, in memory that does not
/// grow with their number. Each pass either counts values in 4096 bins of the interval that holds
/// the rank, which shrinks it 4096-fold, or keeps those in the interval when they are few. The
/// value is exact.
class OrderStatistic {
 public:
  /// `value` is not NaN. Every pass must bring the same values; their order does not matter.
  void add(double value);
  /// Ends a pass; `rank` counts from 0. Returns whether another pass is needed.
  bool another_pass(std::size_t rank);

  double value() const { return value_; }  ///< of the rank
  double next_value() const {
    return next_;
  }  ///< of the rank after it; `value` where it is the last
  std::size_t count() const { return count_; }  ///< of values

 private:
  void to_bins();
  void narrow(std::size_t rank);
  void settle(std::size_t rank);

  bool first_pass_ = true;
  bool keeps_ = true;                     ///< rather than counts
  std::uint64_t low_ = 0, high_ = ~0ULL;  ///< the interval, as ordered keys
  int shift_ = 52;                        ///< a bin's width is 2^shift keys
  std::size_t count_ = 0, below_ = 0, inside_ = 0;
  std::uint64_t least_above_ = ~0ULL;
  std::vector<std::uint64_t> kept_;
  std::vector<std::uint32_t> bins_;
  double value_ = 0.0, next_ = 0.0;
};

}  // namespace gyrostat
