/* In the shape in which MATLAB Coder declares leaky_mean_step.m: a state that goes in and out is a pointer, further
 * results are pointers behind the arguments. Written by hand. */
#ifndef LEAKY_MEAN_STEP_H
#define LEAKY_MEAN_STEP_H

typedef struct {
  double mean;
} struct0_T;

extern void leaky_mean_step(struct0_T *state, double gyro_dps, double time_constant, double *estimate,
                            double *innovation);

#endif
