#include <gyrostat/results/render/interval.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gyrostat {
namespace {

/// Decimal places of a value whose half width is told to two digits.
int places_for(double half_width) {
  return 1 - static_cast<int>(std::floor(std::log10(half_width)));
}

}  // namespace

std::string with_half_width(double value, double half_width) {
  if (!(half_width > 0.0) || !std::isfinite(half_width)) return fmt::format("{:.4g}", value);
  const int places = places_for(half_width);
  if (places < 0) return fmt::format("{:.0f} ± {:.0f}", value, half_width);
  if (places > 8) return fmt::format("{:.3e} ± {:.1e}", value, half_width);
  return fmt::format("{:.{}f} ± {:.{}f}", value, places, half_width, places);
}

std::string with_interval(double value, double low, double high) {
  constexpr double alike = 1.25;
  const double below = value - low, above = high - value;
  const double farther = std::max(below, above), nearer = std::min(below, above);
  if (!(farther > alike * nearer)) return with_half_width(value, farther);
  const int places = nearer > 0.0 ? std::max(0, places_for(nearer)) : 99;
  if (places > 8) return fmt::format("{:.3e} ({:.1e} to {:.1e})", value, low, high);
  return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", value, places, low, places, high, places);
}

}  // namespace gyrostat
