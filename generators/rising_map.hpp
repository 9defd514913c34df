#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace gyrostat {

/// An odd, rising map of a deviation: on straight lines from the origin through the knots, and on
/// along the last. Knots end before the first that is no farther out than the one before it.
template <std::size_t Most>
class RisingMap {
 public:
  struct Knot {
    double from, to;  ///< sizes
  };

  explicit RisingMap(const std::array<Knot, Most>& knots) : knots_(knots) {
    while (count_ < Most && knots_[count_].from > before(count_).from) ++count_;
  }

  bool is_empty() const { return count_ == 0; }

  double operator()(double deviation) const {
    const double size = std::abs(deviation);
    std::size_t k = 0;
    while (k + 1 < count_ && size > knots_[k].from) ++k;
    const Knot below = before(k), above = knots_[k];
    const double slope = (above.to - below.to) / (above.from - below.from);
    return std::copysign(below.to + slope * (size - below.from), deviation);
  }

 private:
  Knot before(std::size_t k) const { return k == 0 ? Knot{0.0, 0.0} : knots_[k - 1]; }

  std::array<Knot, Most> knots_;
  std::size_t count_ = 0;
};

}  // namespace gyrostat
