#include <gyrostat/diagnosis/remainder/replicated.hpp>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/gap/lens.hpp>
#include <gyrostat/generators/fast_part.hpp>

namespace gyrostat::gap {
namespace {

/// Others than those that a remainder is judged by.
constexpr std::uint32_t first_replica = 1000;

Replicated::Look look_at(const Conditions& conditions, const Series& series) {
  Scene scene(conditions, series, train_alone);
  Replicated::Look look;
  FastPart part;
  auto& error = scene.rate_error_dps;
  std::vector<double> fast(error.size(), no_value);
  for (std::size_t i = 0; i < error.size(); ++i)
    if (!is_missing(error[i])) fast[i] = std::abs(part(conditions.series().t_s, i, error[i]));
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(fast[i])) look.fast_dps.push_back(fast[i]);
  std::sort(look.fast_dps.begin(), look.fast_dps.end());
  for (const double density : scene.spectra[index_of(Part::train)].density)
    look.log_density.push_back(level(density));
  look.error_dps = std::move(error);
  look.slow_dps = std::move(scene.slow_dps);
  look.heading_deg = std::move(scene.heading_error_deg);
  return look;
}

}  // namespace

Replicated::Replicated(const Simulator& simulator, const Series& series, const Scenario& scenario)
    : recording(look_at(simulator.conditions(), series)), replicas(replicas_made) {
  tbb::parallel_for(std::size_t{0}, replicas_made, [&](std::size_t k) {
    simulator.interrupt().check();
    replicas[k] =
        look_at(simulator.conditions(),
                simulator.replica(scenario, first_replica + static_cast<std::uint32_t>(k)));
  });
}

Against::Against(double observed, const std::vector<double>& replicated) {
  const auto count = static_cast<double>(replicated.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : replicated) mean += value / count;
  for (const double value : replicated) squares += (value - mean) * (value - mean);
  off = observed - mean;
  variance = squares / (count - 1.0) * (1.0 + 1.0 / count);
}

}  // namespace gyrostat::gap
