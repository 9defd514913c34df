#pragma once

#include <any>
#include <deque>
#include <string_view>
#include <vector>

#include <gyrostat/core/registry.hpp>
#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap {

class Conditions;
struct Scene;

/// A lens without its C++ type.
struct LensType {
  static constexpr std::string_view kind = "lens";

  std::string_view id, title, channel, coordinate, unit;
  double least_spread;
  /// The lens as it looks at a part of a recording, and where it looks.
  std::any (*bind)(const Conditions& conditions, Part part);
  const std::vector<Interval>& (*at)(const std::any& lens);
  void (*read)(const std::any& lens, const Scene& scene, std::span<double> readings);

  static void describe_all(std::deque<LensType>& to);
};

inline Registry<LensType>& lens_types() { return Registry<LensType>::all(); }

template <class L>
LensType describe_lens(std::string_view id) {
  return {
      .id = id,
      .title = L::title,
      .channel = L::channel,
      .coordinate = L::coordinate,
      .unit = L::unit,
      .least_spread = L::least_spread,
      .bind = [](const Conditions& conditions, Part part) { return std::any(L(conditions, part)); },
      .at = [](const std::any& lens) -> const std::vector<Interval>& {
        return std::any_cast<L>(&lens)->at;
      },
      .read = [](const std::any& lens, const Scene& scene,
                 std::span<double> readings) { std::any_cast<L>(&lens)->read(scene, readings); }};
}

}  // namespace gyrostat::gap
