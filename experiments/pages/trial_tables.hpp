#pragma once

#include <gyrostat/experiments/pages/table_request.hpp>

namespace gyrostat::tabling {

/// One trial over time, in bins: the mean (and of rates the spread) of each method's error.
Table traces(const Request& request, Results& results);

/// Allan deviation of one trial's compensated rates, with confidence bands.
Table allan(const Request& request, Results& results);

}  // namespace gyrostat::tabling
