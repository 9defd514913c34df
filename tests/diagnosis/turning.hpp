#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap {

/// Turns of unlike frequencies, each for 20 s, from rest.
inline Series turning(const std::vector<Effect>& effects, std::uint64_t seed) {
  Scenario s = moving();
  s.sampling = {400.0, 25.0};
  s.effects = effects;
  s.motion = turned_at_25_hz(10000, [](double t_s) {
    const double of_turn = std::fmod(t_s, 20.0), turn = std::floor(t_s / 20.0);
    const double hz = 0.1 + 0.9 * std::fmod(0.618 * turn, 1.0);
    return 50.0 * std::sin(2.0 * std::numbers::pi * hz * of_turn) *
           std::sin(std::numbers::pi * of_turn / 20.0);
  });
  return recorded(s, seed, true);
}

}  // namespace gyrostat::gap
