/* A filter in C: the mean of the last samples, taken for the gyro's error. */
#include <gyrostat_plugin.h>
#include <math.h>
#include <stdlib.h>

typedef struct { double gain, mean; } leaky_mean;

static void* create(const double* values) {
  leaky_mean* filter = calloc(1, sizeof *filter);
  if (filter) filter->gain = 1.0 / values[0];
  return filter;
}

static void step(void* state, const gyrostat_sample* samples, gyrostat_step* steps, size_t count) {
  leaky_mean* filter = state;
  for (size_t i = 0; i < count; ++i) {
    const double innovation = samples[i].gyro_dps - filter->mean;
    if (isnan(innovation)) steps[i].status = GYROSTAT_NO_MEASUREMENT;
    else filter->mean += filter->gain * (steps[i].innovation_dps = innovation);
    steps[i].estimate_dps = filter->mean;
  }
}

static const gyrostat_parameter parameters[] = {
    {"time_constant", "samples", "memory of the mean", .from = 1, .to = INFINITY, .value = 50}};
static const gyrostat_filter filter = {
    .name = "c_mean", .title = "leaky mean, in C", .parameter_count = 1, .parameters = parameters,
    .create = create, .step = step, .destroy = free};
static const gyrostat_plugin plugin = {GYROSTAT_PLUGIN_ABI, .filter_count = 1, .filters = &filter};
const gyrostat_plugin* gyrostat_describe(void) { return &plugin; }
