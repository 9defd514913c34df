#include <algorithm>
#include <type_traits>

#include <gyrostat/diagnosis/gap/spectral_bands.hpp>
#include <gyrostat/diagnosis/starts/start.hpp>
#include <gyrostat/diagnosis/typed.hpp>

namespace gyrostat::gap {
namespace {

using namespace effects;

template <class E>
constexpr bool is_slow_signature =
    std::is_same_v<E, RateRamp> || std::is_same_v<E, ThermalCurvature> ||
    std::is_same_v<E, ThermalHysteresis> || std::is_same_v<E, ThermalLag> ||
    std::is_same_v<E, GSensitivity>;

template <class E>
constexpr bool deterministic =
    is_slow_signature<E> || std::is_same_v<E, Sinusoidal> || std::is_same_v<E, ScaleFactor> ||
    std::is_same_v<E, ScaleAsymmetry> || std::is_same_v<E, SensorBandwidth> ||
    std::is_same_v<E, Saturation> || std::is_same_v<E, DeadZone> || std::is_same_v<E, HardIron> ||
    std::is_same_v<E, SoftIron> || std::is_same_v<E, CompassLag>;

}  // namespace

double Evidence::seconds_of_train() const {
  double samples = 0.0;
  for (const auto& span : simulator.conditions().spans(Part::train))
    samples += static_cast<double>(span.size());
  return samples * simulator.conditions().interval_s();
}

std::vector<Start> starts(const Effect& effect, const Evidence& evidence) {
  std::vector<Start> all;
  with_type(effect, [&](const auto& any) {
    all = [&] {
      if (!is_slow_signature<std::decay_t<decltype(any)>>) return start(any, evidence);
      // The effect itself inflated the random walk of the baseline: first as if there were none,
      // then with what is left without the effect.
      Evidence cleaner = evidence;
      cleaner.baseline.random_error.delta1_dps = cleaner.baseline.random_error.delta2_dps = 0.0;
      for (int pass = 0; pass < 2; ++pass)
        cleaner.baseline.random_error = start(any, cleaner).front().rest.random_error;
      auto found = start(any, cleaner);
      cleaner.baseline.random_error = found.front().rest.random_error;
      const auto seen = trace_of(cleaner, Trace::slow_rate);
      const double unexplained =
          match(signatures(cleaner, Trace::slow_rate, {found.front().effect}), seen).unexplained;
      found.front().most_gain =
          0.5 * static_cast<double>(seen.size()) * (1.0 / std::max(unexplained, 1e-12) - 1.0);
      return found;
    }();
  });
  return all;
}

bool is_what_it_is_called(const Effect& effect, const Conditions& conditions) {
  const double shortest_s = 5.0 * conditions.interval_s();
  const double longest_s = conditions.interval_s() * static_cast<double>(conditions.size());
  if (const auto* v = effect.as<Vibration>()) {
    const double line_hz =  // what its spectrum would show of a line
        3.0 * spectrum_resolution_hz(conditions.spans(Part::train), conditions.rate_hz());
    return v->bandwidth_hz < 0.5 * v->centre_hz &&
           v->bandwidth_hz > std::max(0.02 * v->centre_hz, line_hz);
  }
  if (const auto* g = effect.as<GaussMarkov>()) return g->correlation_time_s > shortest_s;
  if (const auto* t = effect.as<Telegraph>())  // it is seen to come back to its levels
    return t->mean_dwell_s > shortest_s && t->mean_dwell_s < longest_s / 10.0;
  if (const auto* b = effect.as<MagneticBursts>()) return b->std_deg < 90.0;
  return true;
}

bool is_deterministic(const Effect& effect) {
  bool yes = false;
  with_type(effect, [&]<class E>(const E&) { yes = deterministic<E>; });
  return yes;
}

std::vector<std::string_view> free_parameters(const Effect& effect) {
  std::vector<std::string_view> names;
  for (const auto& field : effect.fields())
    if (field.name != "reference_C" && field.name != "lsb_dps" && field.name != "poles")
      names.push_back(field.name);
  return names;
}

}  // namespace gyrostat::gap
