#include <cstdio>

#include <analysis/errors.hpp>
#include <core/series.hpp>
#include <core/types.hpp>
#include <generators/scenario.hpp>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/core/filters/kf.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/core/track.hpp>
#include <gyrostat/generators/scenario.hpp>

/// Own names and gyrostat's, side by side.
int main() {
  const Series ours = Scenario{.samples = 10}.make();

  gyrostat::Series theirs;
  gyrostat::synthesise(gyrostat::Scenario{}, {.seed = 1, .trial = 0}, theirs);
  gyrostat::Track track;
  gyrostat::run_filter(gyrostat::filters::Kf<double>({}), theirs, track);
  const auto errors = gyrostat::track_errors(theirs, track);

  std::printf("ours %g, theirs %g dps\n", mean_error(ours), errors.rate.mean);
  return ours.samples.size() == 10 && !theirs.gyro_dps.empty() ? 0 : 1;
}
