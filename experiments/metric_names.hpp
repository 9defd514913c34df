#pragma once

#include <cstddef>
#include <string>

namespace gyrostat {

/// Of the metric at an index into Metrics.
std::string metric_title(std::size_t metric);
std::string metric_unit(std::size_t metric);

}  // namespace gyrostat
