/* What makes a plug-in of the function that MATLAB Coder wrote. */
#include <gyrostat_plugin.h>
#include <math.h>
#include <stdlib.h>

#include "leaky_mean_step.h"

typedef struct { struct0_T state; double time_constant; } instance;

static void* create(const double* values) {
  instance* self = calloc(1, sizeof *self);
  if (self) self->time_constant = values[0];
  return self;
}

static void step(void* filter, const gyrostat_sample* samples, gyrostat_step* steps, size_t count) {
  instance* self = filter;
  for (size_t i = 0; i < count; ++i) {
    if (isnan(samples[i].gyro_dps)) {
      steps[i].estimate_dps = self->state.mean;
      steps[i].status = GYROSTAT_NO_MEASUREMENT;
      continue;
    }
    leaky_mean_step(&self->state, samples[i].gyro_dps, self->time_constant, &steps[i].estimate_dps,
                    &steps[i].innovation_dps);
  }
}

static const gyrostat_parameter parameters[] = {
    {"time_constant", "samples", "memory of the mean", .from = 1, .to = INFINITY, .value = 50}};
static const gyrostat_filter filter = {
    .name = "coder_mean", .title = "leaky mean, by MATLAB Coder", .parameter_count = 1, .parameters = parameters,
    .create = create, .step = step, .destroy = free};
static const gyrostat_plugin plugin = {GYROSTAT_PLUGIN_ABI, .filter_count = 1, .filters = &filter};
const gyrostat_plugin* gyrostat_describe(void) { return &plugin; }
