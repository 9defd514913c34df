#include <algorithm>

#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/start.hpp>

namespace gyrostat::gap {

using namespace effects;

std::vector<Start> start(RateRamp, const Evidence& e) {
  return cleaned(
      e, scaled(e, Trace::slow_rate, RateRamp{}, [](auto& p, double a) { p.slope_dps_per_s = a; }));
}

std::vector<Start> start(ThermalCurvature, const Evidence& e) {
  const auto& T = e.simulator.conditions().slow_temperature_C();
  const double middle =
      0.5 * (*std::min_element(T.begin(), T.end()) + *std::max_element(T.begin(), T.end()));
  return cleaned(e, scaled(e, Trace::slow_rate, ThermalCurvature{1.0, middle},
                           [](auto& p, double a) { p.curvature_dps_per_C2 = a; }));
}

std::vector<Start> start(ThermalHysteresis, const Evidence& e) {
  const auto& T = e.simulator.conditions().slow_temperature_C();
  const double span = *std::max_element(T.begin(), T.end()) - *std::min_element(T.begin(), T.end());
  return cleaned(
      e, scaled_over(e, Trace::slow_rate, ThermalHysteresis{}, &ThermalHysteresis::width_C,
                     0.02 * span, 0.45 * span, [](auto& p, double a) { p.amplitude_dps = a; }));
}

std::vector<Start> start(ThermalLag, const Evidence& e) {
  const auto& c = e.simulator.conditions();
  return cleaned(e, scaled_over(e, Trace::slow_rate, ThermalLag{}, &ThermalLag::time_constant_s,
                                2.0 * c.slow_interval_s(),
                                0.5 * c.slow_interval_s() * static_cast<double>(c.slow_size()),
                                [](auto& p, double a) { p.sensitivity_dps_per_C = a; }));
}

std::vector<Start> start(GSensitivity, const Evidence& e) {
  const auto columns = signatures(
      e, Trace::slow_rate,
      {GSensitivity{1.0, 0.0, 0.0}, GSensitivity{0.0, 1.0, 0.0}, GSensitivity{0.0, 0.0, 1.0}});
  const auto found = match(columns, trace_of(e, Trace::slow_rate)).amplitudes;
  return cleaned(e, GSensitivity{found[0], found[1], found[2]});
}

}  // namespace gyrostat::gap
