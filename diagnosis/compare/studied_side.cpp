#include <gyrostat/diagnosis/compare/studied_side.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {

Found StudiedSide::found(std::string_view effect) const {
  Found found;
  double best = -1.0;
  std::size_t showing = 0;
  for (const auto& trace : traces) {
    const auto effects = trace->effects(effect);
    if (effects.empty()) continue;
    ++showing;
    const double odds = trace->log_odds(effect);
    found.log_odds += odds;
    if (odds <= best) continue;
    best = odds;
    found.effects = effects;
    found.errors = trace->errors_of(effect);
  }
  if (2 * showing < traces.size()) return {};
  return found;
}

std::vector<std::string> StudiedSide::names() const {
  std::vector<std::string> names;
  for (const auto& cause : cause_types())
    if (!found(cause.id).effects.empty()) names.emplace_back(cause.id);
  return names;
}

double StudiedSide::mean_of(double (TraceStudy::*noise)() const) const {
  double square = 0.0;
  for (const auto& trace : traces) square += std::pow((*trace.*noise)(), 2);
  return std::sqrt(square / static_cast<double>(traces.size()));
}

double StudiedSide::resolution_dps() const {
  double coarsest = 0.0;
  for (const auto& trace : traces) coarsest = std::max(coarsest, trace->resolution_dps());
  return coarsest;
}

}  // namespace gyrostat::gap
