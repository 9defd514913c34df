#include <gyrostat/diagnosis/likelihood/nameless.hpp>

#include <algorithm>

#include <gyrostat/diagnosis/likelihood/nameless_colour.hpp>
#include <gyrostat/diagnosis/likelihood/nameless_mean.hpp>
#include <gyrostat/generators/effects/empirical_compass_noise.hpp>

namespace gyrostat::gap {

std::vector<Nameless> nameless_parts(const Simulator& simulator, const Series& recording,
                                     const SetFitter& fitter, const Scenario& fitted,
                                     const Scenario& set) {
  const auto& conditions = simulator.conditions();
  std::vector<Nameless> parts;
  if (auto mean = mean_over_temperature(conditions, fitter, fitted)) parts.push_back(*mean);
  if (auto mean = mean_over_rate(conditions, fitter, fitted)) parts.push_back(*mean);
  if (auto noise = colour_of_the_noise(conditions, fitter, fitted)) parts.push_back(*noise);
  if (auto compass = colour_of_the_compass(simulator, recording, set)) parts.push_back(*compass);
  return parts;
}

bool is_nameless(const Effect& effect) { return effect.id().starts_with("empirical_"); }

Scenario with_nameless(Scenario set, const std::vector<Nameless>& parts) {
  for (const auto& part : parts) {
    if (part.beside) set.random_error = *part.beside;
    // The colour is that of all the noise there is.
    if (part.effect.as<effects::EmpiricalCompassNoise>()) set.compass.noise_std_deg = 0.0;
    // What changes all errors stands before what the converter does to them.
    const auto at = part.effect.stage() != Stage::conversion
                        ? set.effects.end()
                        : std::find_if(set.effects.begin(), set.effects.end(), [](const auto& e) {
                            return e.stage() == Stage::conversion && !is_nameless(e);
                          });
    set.effects.insert(at, part.effect);
  }
  return set;
}

}  // namespace gyrostat::gap
