// A sound filter called `mine`, with a gain that is defined where it is compiled: two libraries
// that say the same of themselves and are not the same.
#include <cmath>

#include <gyrostat/experiments/plugins/gyrostat_plugin.h>

namespace {

void* create(const double*) { return new double(0.0); }
void step(void* filter, const gyrostat_sample* samples, gyrostat_step* steps, size_t count) {
  double& mean = *static_cast<double*>(filter);
  for (size_t i = 0; i < count; ++i) {
    const double beyond = samples[i].gyro_dps - mean;
    if (std::abs(beyond) < 1e6) mean += GAIN * beyond;  // neither missing nor gross
    steps[i].estimate_dps = mean;
  }
}
void destroy(void* filter) { delete static_cast<double*>(filter); }

const gyrostat_filter filter = {
    "mine", "for tests: a mean", GYROSTAT_RANDOM_ERROR, 0, 0, nullptr, create, step, destroy};
const gyrostat_plugin plugin = {GYROSTAT_PLUGIN_ABI, 1, 0, &filter, nullptr};

}  // namespace

const gyrostat_plugin* gyrostat_describe(void) { return &plugin; }
