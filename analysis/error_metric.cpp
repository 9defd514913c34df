#include <gyrostat/analysis/error_metric.hpp>

#include <cmath>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/error.hpp>

namespace gyrostat {

std::size_t error_metric_named(const std::string& name, const std::string& place) {
  const auto index = metric_named(name, place);
  const auto is_error = [](const MetricType& type) {
    return type.goal == Goal::small || type.goal == Goal::near_zero;
  };
  if (is_error(metric_types()[index])) return index;
  std::string allowed;
  for (const auto& type : metric_types())
    if (is_error(type)) allowed += (allowed.empty() ? "" : ", ") + type.id;
  throw InputError(place, "small is not good of '" + name + "'; allowed: " + allowed);
}

double error_of(std::size_t metric, double value) {
  return metric_types()[metric].goal == Goal::near_zero ? std::abs(value) : value;
}

}  // namespace gyrostat
