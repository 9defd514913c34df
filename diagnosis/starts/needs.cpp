#include <gyrostat/diagnosis/starts/needs.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {
namespace {

constexpr double least_duration_s = 600.0;
constexpr double least_turn_deg = 90.0;

}  // namespace

double extent(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

namespace needs {

std::string nothing(const Conditions& /*conditions*/) { return {}; }

std::string warming(const Conditions& c) {
  if (!c.has_temperature()) return "there is no temperature_C column; record the sensor's";
  const double span = extent(c.slow_temperature_C());
  if (span >= least_warming_C) return {};
  return fmt::format("the temperature spans {:.2g} °C; at least {:g} °C are needed", span,
                     least_warming_C);
}

std::string time(const Conditions& c) {
  const double duration_s = c.interval_s() * static_cast<double>(c.size());
  if (duration_s >= least_duration_s) return {};
  return fmt::format("the recording lasts {:.4g} s; at least {:g} s are needed", duration_s,
                     least_duration_s);
}

std::string motion(const Conditions& c) {
  if (c.series().rate_ref_dps.empty())
    return "there is no rate_ref_dps column; add one: the rate of a rate table, or the attitude of "
           "a motion capture differentiated";
  return c.has_motion() ? "" : "the reference rate never changes; turn the sensor to and fro";
}

std::string heading(const Conditions& c) {
  return c.has_heading() ? "" : "there is no heading_deg column; record a compass beside it";
}

std::string turns(const Conditions& c) {
  if (auto why = heading(c); !why.empty()) return why;
  const double turned = extent(c.turned_deg());
  if (turned >= least_turn_deg) return {};
  return fmt::format("the reference turns through {:.3g} deg; at least {:g} deg are needed", turned,
                     least_turn_deg);
}

}  // namespace needs
}  // namespace gyrostat::gap
