#include <array>

#include <gyrostat/diagnosis/gap/allan_components.hpp>
#include <gyrostat/diagnosis/starts/start.hpp>

namespace gyrostat::gap {

using namespace effects;

namespace {

/// With a random walk beside the component and without.
std::array<AllanComponents, 2> slow_fits(const Evidence& e, SlowComponent component) {
  const auto& conditions = e.simulator.conditions();
  const auto fit = [&](bool walk) {
    return fit_allan_components(conditions, e.scene, component, walk);
  };
  return {fit(true), fit(false)};
}

template <class Make>
std::vector<Start> slow_starts(const Evidence& e, SlowComponent component, const Make& make) {
  std::vector<Start> found;
  for (const auto& fit : slow_fits(e, component))
    found.push_back({make(fit), {fit.random_error, e.baseline.thermal_drift}});
  return found;
}

}  // namespace

std::vector<Start> start(BiasInstability, const Evidence& e) {
  return slow_starts(e, SlowComponent::flicker,
                     [](const auto& fit) { return BiasInstability{fit.slow_std_dps}; });
}

std::vector<Start> start(GaussMarkov, const Evidence& e) {
  return slow_starts(e, SlowComponent::gauss_markov, [](const auto& fit) {
    return GaussMarkov{fit.slow_std_dps, fit.correlation_time_s};
  });
}

std::vector<Start> start(Telegraph, const Evidence& e) {
  return slow_starts(e, SlowComponent::gauss_markov, [](const auto& fit) {
    return Telegraph{fit.slow_std_dps, 2.0 * fit.correlation_time_s};
  });
}

}  // namespace gyrostat::gap
