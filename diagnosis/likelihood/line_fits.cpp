#include <gyrostat/diagnosis/likelihood/line_fits.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>

namespace gyrostat::gap {
namespace {

/// A line that fills a band and whose phase wanders by so many radians within a correlation time:
/// few leave it the skirts of a resonance, many none.
Effect wandering_line_in(const Resonance& band, double radians) {
  const double wander_hz = 0.5 * band.bandwidth_hz * std::max(1.0, 1.0 / radians);
  return with_values("wandering_line",
                     {{"amplitude_dps", std::sqrt(2.0 * band.variance)},
                      {"frequency_hz", band.centre_hz},
                      {"wander_hz", wander_hz},
                      {"correlation_time_s", radians / (2.0 * std::numbers::pi * wander_hz)}});
}

}  // namespace

Standing with_wandering_line(const SetBench& bench, const Standing& standing, std::size_t at,
                             const LineTrack& track) {
  const auto band = band_of_line(standing.scenario.effects[at]);
  Standing best = standing;
  best.score = -1e300;
  std::vector<Effect> starts;
  if (track.over_band >= clear_shape)
    starts.emplace_back(track.line);
  else
    starts = {wandering_line_in(band, 3.0), wandering_line_in(band, 0.5)};
  for (const auto& start : starts) {
    Scenario scenario = standing.scenario;
    scenario.effects[at] = start;
    if (best.score < -1e299) best.scenario = scenario;  // as it is where no fit is called so
    constexpr int iterations = 15;
    if (auto fit = bench.fitted(scenario, standing.fitter, iterations); fit.score > best.score)
      best = std::move(fit);
  }
  return best;
}

void hold_within(const Conditions& conditions, Effect& line) {
  constexpr double times = 20.0;
  double& memory_s = line.value(field_of(line, "correlation_time_s"));
  memory_s =
      std::min(memory_s, conditions.interval_s() * static_cast<double>(conditions.size()) / times);
}

Standing with_resonance(const SetBench& bench, const Standing& standing, std::size_t at) {
  const auto band = band_of_line(standing.scenario.effects[at]);
  Standing best = standing;
  best.scenario.effects[at] = with_values("vibration", {{"std_dps", std::sqrt(band.variance)},
                                                        {"centre_hz", band.centre_hz},
                                                        {"bandwidth_hz", band.bandwidth_hz}});
  constexpr int iterations = 15;
  if (auto fit = bench.fitted(best.scenario, standing.fitter, iterations); fit.score > -1e299)
    best = std::move(fit);
  return best;
}

Standing with_line(const SetBench& bench, Standing standing, const Effect& line) {
  standing.scenario.effects.push_back(line);
  constexpr int iterations = 15;
  if (auto fit = bench.fitted(standing.scenario, standing.fitter, iterations); fit.score > -1e299)
    return fit;
  return standing;
}

}  // namespace gyrostat::gap
