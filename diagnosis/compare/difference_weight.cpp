#include <gyrostat/diagnosis/compare/difference_weight.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

constexpr double beyond_doubt = 1e3;  ///< log odds

/// Half of the squared differences of parameters over their errors.
Weight by_errors(const Found& real, const Found& simulated) {
  Weight evidence{0.0, 0.0};
  const auto &a = real.effects.front(), &b = simulated.effects.front();
  for (std::size_t i = 0; i < a.fields().size(); ++i) {
    const double error = std::hypot(real.errors[i], simulated.errors[i]);
    if (is_missing(error) || !(error > 0.0)) continue;
    evidence.log_odds += 0.5 * std::pow((a.value(i) - b.value(i)) / error, 2);
    evidence.parameters += 1.0;
  }
  evidence.parameters = std::max(1.0, evidence.parameters);
  return evidence;
}

}  // namespace

Weight by_losses(const Losses& losses, double parameters) {
  const double both = losses.real + losses.simulated;
  return {both > 0.0 ? losses.real * losses.simulated / both : 0.0, std::max(1.0, parameters)};
}

bool has_loss(const CauseType& cause) {
  const bool is_read_off =
      cause.id == "quantization" || cause.id == "saturation" || cause.id == "stale_samples";
  return !is_read_off && cause.signature != Signature::slow &&
         (cause.enter != nullptr || cause.signature == Signature::repeated) &&
         cause.effect().stage() != Stage::compass;
}

Losses losses_of(const CauseType& cause, const StudiedSide& real, const StudiedSide& simulated) {
  const auto of_real = real.found(cause.id), of_simulated = simulated.found(cause.id);
  Losses losses;
  for (const auto& trace : real.traces)
    losses.real += trace->loss_with(cause.id, of_simulated.effects);
  for (const auto& trace : simulated.traces)
    losses.simulated += trace->loss_with(cause.id, of_real.effects);
  return losses;
}

Weight weight_of(const CauseType& cause, const StudiedSide& real, const StudiedSide& simulated) {
  if (cause.id == "quantization" || cause.id == "saturation")
    return by_losses({beyond_doubt, beyond_doubt}, 1.0);
  if (!has_loss(cause)) return by_errors(real.found(cause.id), simulated.found(cause.id));
  return by_losses(losses_of(cause, real, simulated), double(cause.free_parameters.size()));
}

}  // namespace gyrostat::gap
