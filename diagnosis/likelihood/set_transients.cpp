#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <numbers>

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>

namespace gyrostat::gap {

void SetSearcher::look_for_transients(const std::vector<char>& hidden, FoundSet& found) const {
  if (is_coarse_) return;  // a level that is at an edge of the grid for once comes and goes
  std::vector<Resonance> lines;
  constexpr double with_skirts = 3.0;  // which come and go with a burst
  for (const auto& effect : found.scenario.effects) {
    const bool comes_and_goes = effect.id() == "vibration_bursts";
    if (!comes_and_goes && !is_line(effect.id())) continue;
    auto& line = lines.emplace_back(band_of_line(effect));
    if (!comes_and_goes) continue;
    const auto rate_of = [&](std::string_view name) {
      return 1.0 / effect.value(field_of(effect, name));
    };
    const double gated_hz =
        (rate_of("mean_duration_s") + rate_of("mean_interval_s")) / std::numbers::pi;
    line.bandwidth_hz = with_skirts * std::max(line.bandwidth_hz, gated_hz);
  }
  const auto left = bench_.rate_left_by(found.scenario, hidden);
  for (const auto part : both_parts)
    found.transients[index_of(part)] = clearest_transient(conditions_, part, left, lines);
  if (const auto& transient = found.transients[index_of(Part::train)])
    found.unexplained.push_back({"transient", transient->p_value});
}

}  // namespace gyrostat::gap
