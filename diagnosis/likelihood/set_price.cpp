#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/arima_law.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/starts/slow_noise.hpp>

namespace gyrostat::gap {
namespace {

/// What a parameter gains by chance: half a nat, and as much again as makes chance rare.
constexpr double of_a_parameter = 1.5;

/// White noise belongs in R: where the memory beside the walk were the larger, the noise would have
/// passed a filter, and that is an effect.
bool has_white_noise(const Scenario& scenario) {
  const auto& e = scenario.random_error;
  return e.phi == 0.0 ||
         ArimaLaw::of(e).variance() <= e.measurement_noise_std_dps * e.measurement_noise_std_dps;
}

/// How many parameters a fit moves, amplitudes of slow signatures aside; one that is 0 belongs to
/// another form.
std::size_t sizes_of(const Effect& effect, const CauseType& cause) {
  const auto first = is_taken_out(effect) ? 0 : static_cast<std::ptrdiff_t>(cause.amplitudes);
  return static_cast<std::size_t>(
      std::count_if(cause.free_parameters.begin() + first, cause.free_parameters.end(),
                    [&](auto name) { return effect.value(field_of(effect, name)) != 0.0; }));
}

/// How many of those are not alike on all axes.
double own_sizes_of(const Effect& effect, const CauseType& cause) {
  std::size_t alike = 0;
  for (const auto name : cause.alike) alike += effect.value(field_of(effect, name)) != 0.0;
  return static_cast<double>(sizes_of(effect, cause) - alike);
}

/// Whether the rate passes the filter that colours the noise: that is one filter, and no second
/// surprise.
bool passes_the_noise_filter(const Effect& effect, const Scenario& scenario) {
  constexpr double alike = 0.2;  // of the logarithm of the cutoff
  if (effect.id() != "sensor_bandwidth") return false;
  const double cutoff_hz = effect.value(field_of(effect, "cutoff_hz"));
  return std::any_of(scenario.effects.begin(), scenario.effects.end(), [&](const auto& other) {
    return other.id() == "noise_bandwidth" &&
           std::abs(std::log(other.value(field_of(other, "cutoff_hz")) / cutoff_hz)) < alike;
  });
}

/// A shift by less than half a sample beside a filter is the filter's own: whether its input is
/// held before or after a sample, nobody knows.
bool is_of_the_filter(const Effect& effect, const Scenario& scenario, double interval_s) {
  constexpr double least = 0.6;  // of a sample
  return effect.id() == "time_offset" && has(scenario, "sensor_bandwidth") &&
         std::abs(effect.value(field_of(effect, "offset_s"))) < least * interval_s;
}

/// What forgets within some samples and is stronger than the white noise is white noise that has
/// passed a filter.
bool is_filtered_noise(const Effect& effect, const Scenario& scenario,
                       const Conditions& conditions) {
  if (effect.id() != "gauss_markov") return false;
  return !is_slow(effect.value(field_of(effect, "correlation_time_s")), conditions) &&
         effect.value(field_of(effect, "std_dps")) >
             scenario.random_error.measurement_noise_std_dps;
}

/// A sine within the band of a random line that is the stronger is one of its peaks, unless it is
/// known to stand out.
bool is_of_a_line(const Effect& effect, const Scenario& scenario,
                  std::optional<double> stands_out_hz, double resolution_hz) {
  if (effect.id() != "sinusoidal") return false;
  constexpr double bands = 1.5;
  const double frequency_hz = effect.value(field_of(effect, "frequency_hz"));
  if (stands_out_hz && std::abs(frequency_hz - *stands_out_hz) < resolution_hz) return false;
  const double amplitude_dps = effect.value(field_of(effect, "amplitude_dps"));
  return std::any_of(scenario.effects.begin(), scenario.effects.end(), [&](const auto& other) {
    if (other.id() != "vibration") return false;
    const auto value = [&](std::string_view name) { return other.value(field_of(other, name)); };
    return std::abs(frequency_hz - value("centre_hz")) < bands * value("bandwidth_hz") &&
           0.5 * amplitude_dps * amplitude_dps < value("std_dps") * value("std_dps");
  });
}

}  // namespace

double SetBench::price_of(const Scenario& scenario) const {
  constexpr double beyond_any = 1e300;
  if (!has_white_noise(scenario)) return beyond_any;
  const double values = static_cast<double>(conditions_.train_points().size());
  const double resolution_hz =
      1.0 / (conditions_.interval_s() * static_cast<double>(conditions_.size()));
  // What an ARIMA remembers, two effects would.
  double sum = scenario.random_error.phi != 0.0 ? 2.0 * (prior + of_a_parameter) : 0.0;
  for (const auto& effect : scenario.effects) {
    const auto* cause = cause_types().find(effect.id());
    if (cause == nullptr) continue;
    if (!cause->is_what_it_is_called(effect, conditions_) ||
        is_of_the_filter(effect, scenario, conditions_.interval_s()) ||
        is_filtered_noise(effect, scenario, conditions_) ||
        is_of_a_line(effect, scenario, line_that_stands_out_hz_, resolution_hz))
      return beyond_any;
    if (is_given(effect.id())) sum += of_a_parameter * own_sizes_of(effect, *cause);
    if (is_marked(effect.id())) continue;
    sum += prior + of_a_parameter * static_cast<double>(sizes_of(effect, *cause) +
                                                        (cause->chosen_parameters == nullptr
                                                             ? 0
                                                             : cause->chosen_parameters(effect)));
    if (passes_the_noise_filter(effect, scenario)) sum -= prior;
    // The highest of as many peaks, sought between bins besides.
    if (effect.id() == "sinusoidal") sum += 1.2 * std::log(static_cast<double>(conditions_.size()));
    if (effect.id() == "vibration" || effect.id() == "wandering_line")
      sum += 0.5 * std::log(values);
  }
  return sum;
}

}  // namespace gyrostat::gap
