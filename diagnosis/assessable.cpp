#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/candidate.hpp>
#include <gyrostat/diagnosis/typed.hpp>

namespace gyrostat::gap {
namespace {

using namespace effects;

constexpr double least_temperature_span_C = 4.0;
constexpr double least_slow_duration_s = 600.0;
constexpr double least_turn_deg = 270.0;
constexpr double least_acceleration_mps2 = 0.5;

double span_of(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

std::string needs_temperature(const Conditions& c) {
  if (!c.has_temperature()) return "there is no temperature_C column";
  const double span = span_of(c.slow_temperature_C());
  if (span >= least_temperature_span_C) return {};
  return fmt::format("the temperature spans {:.2g} °C; at least {:g} °C are needed", span,
                     least_temperature_span_C);
}

std::string needs_time(const Conditions& c) {
  const double duration_s = c.interval_s() * static_cast<double>(c.size());
  if (duration_s >= least_slow_duration_s) return {};
  return fmt::format("the recording lasts {:.4g} s; at least {:g} s are needed", duration_s,
                     least_slow_duration_s);
}

std::string needs_motion(const Conditions& c) {
  if (c.series().rate_ref_dps.empty()) return "there is no rate_ref_dps column";
  return c.has_motion() ? "" : "the reference rate never changes";
}

std::string needs_heading(const Conditions& c) {
  return c.has_heading() ? "" : "there is no heading_deg column";
}

std::string needs_turns(const Conditions& c) {
  if (auto why = needs_heading(c); !why.empty()) return why;
  const double turned = span_of(c.turned_deg());
  if (turned >= least_turn_deg) return {};
  return fmt::format("the reference turns through {:.3g} deg; at least {:g} deg are needed", turned,
                     least_turn_deg);
}

template <class E>
std::string why_not(const E& /*effect*/, const Conditions& /*c*/) {
  return {};
}

std::string why_not(const NoiseTemperature&, const Conditions& c) { return needs_temperature(c); }
std::string why_not(const ThermalCurvature&, const Conditions& c) { return needs_temperature(c); }
std::string why_not(const ThermalLag&, const Conditions& c) { return needs_temperature(c); }
std::string why_not(const ThermalHysteresis&, const Conditions& c) {
  if (auto why = needs_temperature(c); !why.empty()) return why;
  const auto& T = c.slow_temperature_C();
  double rise = 0.0, fall = 0.0, low = T.front(), high = T.front();
  for (const double t : T) {
    low = std::min(low, t);
    high = std::max(high, t);
    rise = std::max(rise, t - low);
    fall = std::max(fall, high - t);
  }
  if (std::min(rise, fall) >= least_temperature_span_C) return {};
  return fmt::format(
      "the temperature rises by {:.2g} °C and falls by {:.2g} °C; {:g} °C each way are needed",
      rise, fall, least_temperature_span_C);
}
std::string why_not(const BiasInstability&, const Conditions& c) { return needs_time(c); }
std::string why_not(const RateRamp&, const Conditions& c) { return needs_time(c); }
std::string why_not(const BiasSteps&, const Conditions& c) { return needs_time(c); }
std::string why_not(const ScaleFactor&, const Conditions& c) { return needs_motion(c); }
std::string why_not(const ScaleAsymmetry&, const Conditions& c) { return needs_motion(c); }
std::string why_not(const SensorBandwidth&, const Conditions& c) { return needs_motion(c); }
std::string why_not(const Saturation&, const Conditions& c) { return needs_motion(c); }
std::string why_not(const DeadZone&, const Conditions& c) { return needs_motion(c); }
std::string why_not(const GSensitivity&, const Conditions& c) {
  if (!c.has_acceleration()) return "there are no acc_x_mps2, … columns";
  const double span = std::max(
      {span_of(c.slow_means(c.series().acc_x_mps2)),
       c.series().acc_y_mps2.empty() ? 0.0 : span_of(c.slow_means(c.series().acc_y_mps2)),
       c.series().acc_z_mps2.empty() ? 0.0 : span_of(c.slow_means(c.series().acc_z_mps2))});
  if (span >= least_acceleration_mps2) return {};
  return fmt::format("the acceleration changes by {:.2g} m/s²; at least {:g} m/s² are needed", span,
                     least_acceleration_mps2);
}
std::string why_not(const HardIron&, const Conditions& c) { return needs_turns(c); }
std::string why_not(const SoftIron&, const Conditions& c) { return needs_turns(c); }
std::string why_not(const CompassLag&, const Conditions& c) {
  if (auto why = needs_heading(c); !why.empty()) return why;
  return needs_motion(c);
}
std::string why_not(const MagneticBursts&, const Conditions& c) { return needs_heading(c); }

}  // namespace

std::string why_not_assessable(const Effect& effect, const Conditions& conditions) {
  std::string why;
  with_type(effect, [&](const auto& any) { why = why_not(any, conditions); });
  return why;
}

}  // namespace gyrostat::gap
