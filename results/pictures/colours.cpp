#include <gyrostat/results/pictures/colours.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <gyrostat/results/render/page_style.hpp>

namespace gyrostat {
namespace {

/// Between colours that are equally far from each other, 0 the first and 1 the last.
template <std::size_t N>
std::string between(const std::array<std::array<double, 3>, N>& stops, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (N - 1);
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(at), N - 2);
  const auto mix = [&](std::size_t channel) {
    return static_cast<int>(
        std::lround(stops[k][channel] +
                    (at - static_cast<double>(k)) * (stops[k + 1][channel] - stops[k][channel])));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

}  // namespace

std::string ramp(double share) {
  if (!(share >= 0.0)) return "line";
  // Cividis (Nunez, Anderton & Renslow, PLOS ONE 13, 2018) at five places.
  static constexpr std::array<std::array<double, 3>, 5> cividis = {
      {{0, 34, 78}, {62, 75, 108}, {124, 123, 120}, {187, 175, 113}, {254, 232, 56}}};
  return between(cividis, share);
}

std::string ratio_colour(double ratio) {
  static constexpr std::array<std::array<double, 3>, 3> heat = {
      {{255, 255, 255}, {253, 174, 97}, {215, 48, 39}}};
  return between(heat, std::isfinite(ratio) ? std::log10(std::max(ratio, 1.0)) : 0.0);
}

std::string light_colour(const std::string& property) {
  constexpr std::string_view style = page_style;
  const std::string declared = "--" + property + ": light-dark(";
  const auto at = style.find(declared);
  return at == std::string_view::npos ? "#000000"
                                      : std::string(style.substr(at + declared.size(), 7));
}

bool is_dark(const std::string& colour) {
  const auto part = [&](std::size_t at) { return std::stoi(colour.substr(at, 2), nullptr, 16); };
  return 0.3 * part(1) + 0.59 * part(3) + 0.11 * part(5) < 140.0;
}

}  // namespace gyrostat
