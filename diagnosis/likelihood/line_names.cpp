#include <gyrostat/diagnosis/likelihood/line_names.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/line_shape.hpp>

namespace gyrostat::gap {

void name_lines(const SetBench& bench, const std::vector<char>& hidden, FoundSet& found) {
  constexpr double clear = 4.0;
  for (auto& effect : found.scenario.effects) {
    if (effect.id() != "vibration") continue;
    const double std_dps = effect.value(field_of(effect, "std_dps"));
    const double centre_hz = effect.value(field_of(effect, "centre_hz"));
    const double bandwidth_hz = effect.value(field_of(effect, "bandwidth_hz"));
    const auto left = bench.rate_left_by(found.scenario, hidden);
    const auto shape =
        line_shape(bench.conditions(), left, {std_dps * std_dps, centre_hz, bandwidth_hz});
    const bool bursts = shape.bursts > shape.wandering;
    const double gain = std::max(shape.bursts, shape.wandering);
    const std::string_view name = bursts ? "vibration_bursts" : "wandering_line";
    if (gain < clear) continue;
    const auto known = std::find_if(found.members.begin(), found.members.end(),
                                    [](const auto& m) { return m.effect == "vibration"; });
    if (!bench.is_allowed(name)) {
      if (known != found.members.end()) known->log_odds = -gain;
      continue;
    }
    if (bursts)
      effect = with_values("vibration_bursts", {{"std_dps", shape.on_std_dps},
                                                {"centre_hz", centre_hz},
                                                {"bandwidth_hz", bandwidth_hz},
                                                {"mean_duration_s", shape.on_s},
                                                {"mean_interval_s", shape.off_s}});
    else
      effect = with_values("wandering_line", {{"amplitude_dps", std::sqrt(2.0) * std_dps},
                                              {"frequency_hz", centre_hz},
                                              {"wander_hz", 0.5 * bandwidth_hz},
                                              {"correlation_time_s", 1.0 / bandwidth_hz}});
    if (known != found.members.end()) {
      known->effect = name;
      known->log_odds = std::min(known->log_odds, gain);
    }
  }
  // One name each, however many lines it has.
  auto& members = found.members;
  for (std::size_t k = 1; k < members.size();)
    if (std::any_of(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const auto& m) { return m.effect == members[k].effect; }))
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  for (const auto& effect : found.scenario.effects)
    if (std::none_of(members.begin(), members.end(),
                     [&](const auto& m) { return m.effect == effect.id(); }))
      members.push_back({std::string(effect.id()), clear});
}

}  // namespace gyrostat::gap
