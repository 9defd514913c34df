#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gyrostat::render_detail {

/// From the numbers of an axis to pixels.
struct Scale {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();
  bool logarithmic = false;
  double start = 0.0, length = 1.0;  ///< pixels

  double scaled(double v) const { return logarithmic ? std::log10(v) : v; }
  bool shows(double v) const { return std::isfinite(v) && (!logarithmic || v > 0.0); }
  void include(double v) {
    if (!shows(v)) return;
    from = std::min(from, scaled(v));
    to = std::max(to, scaled(v));
  }
  void widen() {
    if (!(from <= to)) from = 0.0, to = 1.0;
    const double rim = from == to ? 0.5 : 0.03 * (to - from);
    from -= rim;
    to += rim;
  }
  double at(double v) const { return start + length * (scaled(v) - from) / (to - from); }

  /// Logarithmic: the decades, and on request what lies between where there are few of them.
  std::vector<double> ticks(bool fine = false) const {
    std::vector<double> all;
    if (logarithmic) {
      const std::vector<double> within = !fine || to - from > 2.5 ? std::vector{1.0}
                                         : to - from > 0.8
                                             ? std::vector{1.0, 2.0, 5.0}
                                             : std::vector{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
      for (double e = fine ? std::floor(from) : std::ceil(from); e <= to; e += 1.0)
        for (const double part : within)
          if (const double v = part * std::pow(10.0, e); scaled(v) >= from && scaled(v) <= to)
            all.push_back(v);
      return all;
    }
    const double raw = (to - from) / 5.0, decade = std::pow(10.0, std::floor(std::log10(raw)));
    const double part = raw / decade;
    const double step = decade * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
    for (double k = std::ceil(from / step); k * step <= to; k += 1.0) all.push_back(k * step + 0.0);
    return all;
  }
};

}  // namespace gyrostat::render_detail
