#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/start.hpp>

namespace gyrostat::gap {

using namespace effects;

namespace {

double fastest(const Evidence& e) {
  double fastest = 0.0;
  for (const double rate : e.simulator.conditions().series().rate_ref_dps)
    fastest = std::max(fastest, std::abs(rate));
  return fastest;
}

}  // namespace

std::vector<Start> start(ScaleFactor, const Evidence& e) {
  return cleaned(e, scaled(e, Trace::rate, ScaleFactor{}, [](auto& p, double a) { p.error = a; }));
}

std::vector<Start> start(ScaleAsymmetry, const Evidence& e) {
  return cleaned(e,
                 scaled(e, Trace::rate, ScaleAsymmetry{}, [](auto& p, double a) { p.error = a; }));
}

std::vector<Start> start(SensorBandwidth, const Evidence& e) {
  const double rate_hz = e.simulator.conditions().rate_hz();
  return cleaned(e, shaped(e, Trace::rate, SensorBandwidth{}, &SensorBandwidth::cutoff_hz,
                           0.002 * rate_hz, 0.5 * rate_hz));
}

std::vector<Start> start(DeadZone, const Evidence& e) {
  std::vector<Start> found;
  for (const double lost : {0.0, 1.0}) {
    const auto effect = shaped(e, Trace::rate, DeadZone{.lost_beyond = lost},
                               &DeadZone::half_width_dps, 0.001 * fastest(e), 0.5 * fastest(e));
    found.push_back({effect, rest_without(e, effect)});
  }
  return found;
}

std::vector<Start> start(Saturation, const Evidence& e) {
  return cleaned(e, shaped(e, Trace::rate, Saturation{}, &Saturation::limit_dps, 0.05 * fastest(e),
                           1.02 * fastest(e)));
}

}  // namespace gyrostat::gap
