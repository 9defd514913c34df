#pragma once

#include <array>
#include <deque>
#include <span>

#include <gyrostat/core/chosen.hpp>

namespace gyrostat {

/// A quantity over time without its C++ type: `Width` numbers at each time. `Kind` tells
/// temperatures from rates.
template <class Kind, std::size_t Width>
struct ProfileType : ParametricType {
  static constexpr std::string_view kind = "profile";

  void (*at)(const std::any& profile, std::span<const double> t_s,
             std::array<std::span<double>, Width> values) = nullptr;

  static void describe_all(std::deque<ProfileType>& to);
};

using TemperatureType = ProfileType<struct TemperatureKind, 1>;    ///< °C
using MotionType = ProfileType<struct MotionKind, 1>;              ///< true rate, dps
using AccelerationType = ProfileType<struct AccelerationKind, 3>;  ///< specific force, m/s²

using Temperature = Chosen<TemperatureType>;
using Motion = Chosen<MotionType>;
using Acceleration = Chosen<AccelerationType>;

inline auto& temperature_types() { return Registry<TemperatureType>::all(); }
inline auto& motion_types() { return Registry<MotionType>::all(); }
inline auto& acceleration_types() { return Registry<AccelerationType>::all(); }

template <class Type, class P>
Type describe_profile(std::string_view id) {
  return {describe_parametric<P>(id),
          [](const std::any& any, std::span<const double> t_s, auto values) {
            const auto& profile = *std::any_cast<P>(&any);
            for (std::size_t i = 0; i < t_s.size(); ++i) {
              const auto now = profile(t_s[i]);
              if constexpr (requires { now.size(); }) {
                for (std::size_t k = 0; k < now.size(); ++k) values[k][i] = now[k];
              } else {
                values[0][i] = now;
              }
            }
          }};
}

}  // namespace gyrostat
