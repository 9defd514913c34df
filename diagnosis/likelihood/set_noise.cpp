#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/arima_law.hpp>

namespace gyrostat::gap {

Standing SetBench::beside_memory(const Standing& standing) const {
  Standing best;
  const auto law = ArimaLaw::of(standing.scenario.random_error);
  const double white = standing.scenario.random_error.measurement_noise_std_dps;
  const auto try_from = [&](double phi, double memory) {
    Scenario scenario = standing.scenario;
    ArimaLaw{phi, law.walk_dps, memory}.put(scenario.random_error);
    scenario = standing.fitter->with_white_noise_scaled(std::move(scenario));
    if (auto tried = fitted(scenario, standing.fitter, fitting_iterations);
        tried.score > best.score)
      best = std::move(tried);
  };
  for (const double phi : {0.5, 0.85}) {
    try_from(phi, 0.2 * white * white * (1.0 - phi * phi));
    // Without delta2 the walk's steps are themselves a decaying error: seen where the walk shows
    // above the white noise before they have died out.
    if (law.walk_dps > (1.0 - phi) * white) try_from(phi, -phi * law.walk_dps * law.walk_dps);
  }
  return best;
}

Standing SetBench::beside_noise(std::vector<Effect> effects) const {
  Scenario scenario = plain();
  scenario.effects = std::move(effects);
  const auto fitter = fitter_of(scenario);
  if (!fitter) return {};
  const double first = std::max(fitter->reduced().white_std_dps(), 1e-9);
  scenario.random_error.measurement_noise_std_dps = first;
  // A walk far below the noise, and one that an unmodelled motion would call for.
  Standing best;
  for (const double walk : {0.03, 1.0}) {
    scenario.random_error.delta1_dps =
        walk * first / std::sqrt(static_cast<double>(conditions_.cluster()));
    if (auto fit = fitted(scenario, fitter, fitting_iterations); fit.score > best.score)
      best = std::move(fit);
  }
  return best;
}

}  // namespace gyrostat::gap
