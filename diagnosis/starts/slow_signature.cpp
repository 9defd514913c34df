#include <gyrostat/diagnosis/starts/slow_signature.hpp>

#include <algorithm>

#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {

std::vector<Start> beside_its_own_walk(std::vector<Start> (*starts)(const Evidence&),
                                       const Evidence& evidence) {
  // First as if there were no walk, then with what is left of it without the effect.
  Evidence cleaner = evidence;
  cleaner.baseline.random_error.delta1_dps = cleaner.baseline.random_error.delta2_dps = 0.0;
  for (int pass = 0; pass < 2; ++pass)
    cleaner.baseline.random_error = starts(cleaner).front().rest.random_error;
  auto found = starts(cleaner);
  cleaner.baseline.random_error = found.front().rest.random_error;
  const auto seen = trace_of(cleaner, Trace::slow_rate);
  const double unexplained =
      match(signatures(cleaner, Trace::slow_rate, {found.front().effect}), seen).unexplained;
  found.front().most_gain =
      0.5 * static_cast<double>(seen.size()) * (1.0 / std::max(unexplained, 1e-12) - 1.0);
  return found;
}

}  // namespace gyrostat::gap
