#pragma once

#include <cstddef>
#include <string>

namespace gyrostat {

/// The index of the metric called `name`, of which small is good, as of errors and of the
/// logarithmic score; InputError at `place` for another.
std::size_t error_metric_named(const std::string& name, const std::string& place);

/// Its value as methods are compared by it: the size of one with a sign that is best at 0.
double error_of(std::size_t metric, double value);

}  // namespace gyrostat
