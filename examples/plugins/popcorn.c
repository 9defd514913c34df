/* A sensor effect in C: the output is off by a step for a while, now and then. */
#include <gyrostat_plugin.h>
#include <stdlib.h>

/* In each second there is, with some probability, a step. */
static void apply(const double* values, gyrostat_signal* signal, const gyrostat_noise* noise) {
  const double probability = values[0], step_dps = values[1];
  const double* t_s = signal->channel[GYROSTAT_T_S];
  double* gyro_dps = signal->channel[GYROSTAT_GYRO_DPS];
  for (size_t i = 0; i < signal->count; ++i) {
    double chance, size;
    const uint64_t second = (uint64_t)(t_s[i] - t_s[0]);
    noise->uniforms(noise->address, "chance", second, &chance, 1);
    noise->normals(noise->address, "size", second, &size, 1);
    if (chance < probability) gyro_dps[i] += step_dps * size;
  }
}

static const gyrostat_parameter parameters[] = {
    {"probability", "1", "that a second has a step", .from = 0, .to = 1, .value = 0.05},
    {"step_dps", "dps", "standard deviation of a step", .from = 0, .to = 1e3, .value = 0.1}};
static const double absent[] = {0.05, 0.0};
static const gyrostat_effect effect = {
    .name = "popcorn", .title = "now and then the output is off for a second", .stage = GYROSTAT_ELECTRONICS,
    .needs = 1u << GYROSTAT_GYRO_DPS, .parameter_count = 2, .parameters = parameters, .absent = absent,
    .apply = apply};
static const gyrostat_plugin plugin = {GYROSTAT_PLUGIN_ABI, .effect_count = 1, .effects = &effect};
const gyrostat_plugin* gyrostat_describe(void) { return &plugin; }
