#include <gyrostat/diagnosis/compare/added.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include <gyrostat/core/step.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {
namespace {

void add_to_heading(const std::vector<Effect>& effects, const Noise& noise, Series& series) {
  auto& heading = series.heading_deg;
  if (heading.empty()) return;
  double turns = 0.0, last = no_value;  // unwrapped, as an effect on the compass finds it
  for (double& h : heading) {
    if (is_missing(h)) continue;
    if (!is_missing(last)) turns += std::nearbyint((last - (h + turns)) / 360.0) * 360.0;
    last = h += turns;
  }
  for (const auto& effect : effects)
    if (effect.stage() == Stage::compass) effect.apply(series, noise);
  for (double& h : heading) h = std::remainder(h, 360.0);
}

}  // namespace

Series with_added(const Series& trace, const Addition& addition, const std::vector<Effect>& after,
                  double resolution_dps, const Noise& noise) {
  const std::size_t n = trace.size();
  auto error = std::make_shared<std::vector<double>>(trace.gyro_dps);
  double level = 0.0, step = 0.0;
  const double interval_s = n > 1 ? trace.duration_s() / static_cast<double>(n - 1) : 1.0;
  const auto white = noise.stream("added/white"), walk = noise.stream("added/walk");
  for (std::size_t i = 0; i < n; ++i) {
    double& e = (*error)[i];
    if (!trace.rate_ref_dps.empty() && !is_missing(trace.rate_ref_dps[i]))
      e -= trace.rate_ref_dps[i];
    if (is_missing(e)) e = level;  // a gap stays one; what effects remember goes on over it
    level = e;
    if (addition.walk_dps_per_sqrt_s > 0.0)
      step += addition.walk_dps_per_sqrt_s * std::sqrt(interval_s) * walk.normal(i);
    e += step;
    if (addition.white_std_dps > 0.0) e += addition.white_std_dps * white.normal(i);
  }
  Scenario scenario;
  scenario.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  scenario.recorded_noise_dps = error;
  scenario.effects = addition.effects;
  scenario.effects.insert(scenario.effects.end(), after.begin(), after.end());
  Series made, result = trace;
  synthesise_rate_under(scenario, trace, noise, made);
  result.gyro_dps = std::move(made.gyro_dps);
  if (resolution_dps > 0.0)
    for (double& z : result.gyro_dps) z = resolution_dps * std::nearbyint(z / resolution_dps);
  add_to_heading(addition.effects, noise, result);
  return result;
}

}  // namespace gyrostat::gap
