#pragma once

#include <string>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>

namespace gyrostat::gap::needs {

/// A reference rate that changes, with where to get one.
inline std::string told_motion(const Conditions& c) {
  const auto why = motion(c);
  if (why.empty()) return {};
  return why + (c.series().rate_ref_dps.empty()
                    ? "; add one: the rate of a rate table, or the attitude of a motion capture "
                      "differentiated"
                    : "; turn the sensor to and fro");
}

}  // namespace gyrostat::gap::needs
