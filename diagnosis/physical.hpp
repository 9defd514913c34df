#pragma once

#include <cmath>
#include <string>
#include <string_view>

namespace gyrostat::gap {

/// Readings of lenses are logarithms where that makes them normal: of variances, densities and
/// ratios. For people they are what they are logarithms of, of a variance its root.
///
/// Example: an Allan deviation.
///
///   const gap::Physical deviation("ln(dps²)");
///   std::printf("%g %s\n", deviation(-9.2), deviation.unit.c_str());
struct Physical {
  explicit Physical(std::string_view reading) : unit(reading) {
    constexpr std::string_view begin = "ln(", square = "²";
    if (!reading.starts_with(begin)) return;
    is_logarithmic = true;
    unit = reading.substr(begin.size(), reading.size() - begin.size() - 1);
    const auto at = unit.find(square);
    if (at == std::string::npos) return;
    root = true;
    unit.erase(at, square.size());
    if (const auto per = unit.find('/'); per != std::string::npos) unit.insert(per + 1, "√");
  }

  double operator()(double value) const {
    return is_logarithmic ? std::exp(root ? 0.5 * value : value) : value;
  }

  std::string unit;
  bool is_logarithmic = false;
  bool root = false;  ///< of what the reading is the logarithm of
};

}  // namespace gyrostat::gap
