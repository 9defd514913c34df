#pragma once

#include <vector>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

/// What is added to a trace that somebody else's simulator made.
struct Addition {
  double white_std_dps = 0.0;        ///< of white noise
  double walk_dps_per_sqrt_s = 0.0;  ///< K of a random walk
  std::vector<Effect> effects;

  bool is_nothing() const {
    return white_std_dps == 0.0 && walk_dps_per_sqrt_s == 0.0 && effects.empty();
  }
};

/// The trace with that added, under its own times, motion and temperature. Its rate error stands
/// where a scenario's noise does, so that each effect acts at its stage on what is there: an output
/// filter on the trace's own noise. Effects of the compass act on the trace's own heading. `after`
/// are effects of the trace itself that act later than what is added (its grid, its limit) and so
/// act once more; `resolution_dps` is that of the trace's decimals, 0 for none.
Series with_added(const Series& trace, const Addition& addition, const std::vector<Effect>& after,
                  double resolution_dps, const Noise& noise);

}  // namespace gyrostat::gap
