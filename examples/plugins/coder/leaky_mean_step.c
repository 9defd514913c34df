/* In the shape in which MATLAB Coder writes leaky_mean_step.m. Written by hand. */
#include "leaky_mean_step.h"

void leaky_mean_step(struct0_T *state, double gyro_dps, double time_constant, double *estimate,
                     double *innovation)
{
  *innovation = gyro_dps - state->mean;
  state->mean += 1.0 / time_constant * *innovation;
  *estimate = state->mean;
}
