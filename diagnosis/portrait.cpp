#include <gyrostat/diagnosis/portrait.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/gap/scene.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t most_stretches = 600;
constexpr std::size_t most_bands = 300;
constexpr std::uint32_t averaged_replicas = 4;

Envelope envelope_of(const Series& series, const std::vector<double>& values) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Envelope envelope;
  const std::size_t stretches = std::min(most_stretches, values.size());
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t first = s * values.size() / stretches,
                      last = (s + 1) * values.size() / stretches;
    double low = infinity, high = -infinity, sum = 0.0, count = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      if (is_missing(values[i])) continue;
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
      sum += values[i];
      count += 1.0;
    }
    envelope.t_s.push_back(series.t_s[first] - series.t_s.front());
    envelope.low.push_back(count > 0.0 ? low : no_value);
    envelope.high.push_back(count > 0.0 ? high : no_value);
    envelope.mean.push_back(count > 0.0 ? sum / count : no_value);
  }
  return envelope;
}

/// What every replica of the scenario has in common: motion, drift and repeated effects.
std::vector<double> repeated_rate(const Conditions& conditions, Scenario scenario) {
  scenario.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  scenario.thermal_drift.b_dps_s_per_C = 0.0;  // a recorded temperature has steps
  std::erase_if(scenario.effects, [](const Effect& effect) {
    const auto* cause = cause_types().find(effect.id());
    return cause == nullptr || !cause->is_deterministic() || effect.stage() == Stage::compass;
  });
  Series rate;
  synthesise_rate_under(scenario, conditions.series(), {}, rate);
  return rate.gyro_dps;
}

/// The part that is longest.
Spectrum spectrum_of(const Conditions& conditions, const Series& series) {
  return Scene(conditions, series, train_alone).spectra[0];
}

/// Bins of about even width in the logarithm, their densities averaged, as roots.
std::vector<double> in_bands(const std::vector<double>& density, const std::vector<Span>& bands) {
  std::vector<double> roots;
  for (const auto& band : bands) {
    double sum = 0.0;
    for (std::size_t k = band.first; k < band.last; ++k) sum += density[k];
    roots.push_back(std::sqrt(sum / static_cast<double>(band.last - band.first)));
  }
  return roots;
}

std::vector<Span> bands_of(std::size_t bins) {
  std::vector<Span> bands;
  const double growth = std::pow(static_cast<double>(bins), 1.0 / most_bands);
  for (std::size_t first = 1; first < bins;) {
    const auto reach = static_cast<std::size_t>(static_cast<double>(first) * growth);
    const std::size_t last = std::min(bins, std::max(first + 1, reach));
    bands.push_back({first, last});
    first = last;
  }
  return bands;
}

Densities densities_of(const Simulator& simulator, const Series& recording, const Scenario& before,
                       const Scenario& after) {
  const auto& conditions = simulator.conditions();
  const auto observed = spectrum_of(conditions, recording);
  Densities densities;
  if (observed.density.empty()) return densities;
  const auto bands = bands_of(observed.density.size());
  for (const auto& band : bands)
    densities.frequency_hz.push_back(0.5 * static_cast<double>(band.first + band.last - 1) *
                                     observed.resolution_hz);
  const auto simulated = [&](const Scenario& scenario) {
    std::vector<double> mean(observed.density.size(), 0.0);
    for (std::uint32_t k = 0; k < averaged_replicas; ++k) {
      const auto one = spectrum_of(conditions, simulator.replica(scenario, k)).density;
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += one[i] / averaged_replicas;
    }
    return in_bands(mean, bands);
  };
  densities.recording = in_bands(observed.density, bands);
  densities.before = simulated(before);
  densities.after = simulated(after);
  return densities;
}

}  // namespace

Portrait portrait_of(const Simulator& simulator, const Series& recording, const Scenario& before,
                     const Scenario& after) {
  auto left = repeated_rate(simulator.conditions(), after);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = recording.gyro_dps[i] - left[i];
  return {.recorded = envelope_of(recording, recording.gyro_dps),
          .left = envelope_of(recording, left),
          .spectrum = densities_of(simulator, recording, before, after)};
}

}  // namespace gyrostat::gap
