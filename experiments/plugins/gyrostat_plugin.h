/* Filters and sensor effects of your own, for gyrostat: a shared library that defines gyrostat_describe().
 *
 *   cc -O2 -shared -fPIC my_filter.c -o my_filter.so
 *   gyrostat check-plugin my_filter.so
 *   gyrostat run STUDY.json --plugin ./my_filter.so
 *
 * gyrostat calls the library in processes of its own, each from one thread: what crashes there costs the trial
 * that it was in. Several instances of a filter may be alive at once, so state belongs into the instance.
 * A missing value is NaN, in samples and in steps. Nothing here is freed by gyrostat. docs/plugins.md has more. */
#ifndef GYROSTAT_PLUGIN_H
#define GYROSTAT_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of this header. A library for another one is refused, both versions named. */
#define GYROSTAT_PLUGIN_ABI 1u

/* A parameter: it stands in `gyrostat list`, in study files and in designs. One that is called as a parameter of
 * ours (phi, measurement_noise_std_dps, …: gyrostat list filters) is told the calibrated value, in our unit. */
typedef struct gyrostat_parameter {
  const char* name;    /* letters, digits and _ */
  const char* unit;    /* as "dps", "s", "samples"; "1" without */
  const char* meaning; /* one line */
  double from, to;     /* its range, -INFINITY and INFINITY where it has no end */
  double value;        /* by default */
  uint32_t range;      /* of the following; 0: from and to are allowed themselves, and all between */
} gyrostat_parameter;

enum gyrostat_range { GYROSTAT_ABOVE_FROM = 1, GYROSTAT_BELOW_TO = 2, GYROSTAT_WHOLE_NUMBERS = 4 };

/* ---- Filters ---- */

/* One sample of the gyro, and what was measured beside it. */
typedef struct gyrostat_sample {
  double t_s;
  double gyro_dps;
  double temperature_C;
  double heading_deg;    /* compass, within +-180; missing where it is flagged as disturbed */
  double true_rate_dps;  /* missing but for a filter that needs the truth */
  double true_drift_dps; /* the same */
} gyrostat_sample;

enum gyrostat_status {
  GYROSTAT_OK = 0,
  GYROSTAT_NO_MEASUREMENT = 1,        /* nothing to update with at this sample */
  GYROSTAT_RISK_BREAKDOWN = 2,        /* these three: the step was left out, the filter stays at its */
  GYROSTAT_INDEFINITE_COVARIANCE = 3, /* last sound state, and the trial counts as broken down */
  GYROSTAT_NOT_FINITE = 4
};

/* What the filter makes of it. */
typedef struct gyrostat_step {
  double estimate_dps;        /* of the gyro's error, after the update: the compensated rate is gyro - estimate */
  double estimate_variance;   /* dps², missing where the filter knows none */
  double innovation_dps;      /* missing where there was no update */
  double innovation_variance; /* dps² */
  double status;              /* a gyrostat_status */
} gyrostat_step;

enum gyrostat_corrects { GYROSTAT_RANDOM_ERROR = 0, GYROSTAT_THERMAL_DRIFT = 1 };

/* What a filter cannot do without. One that needs the truth is a bound, no contender. */
enum gyrostat_needs { GYROSTAT_NEEDS_TEMPERATURE = 1, GYROSTAT_NEEDS_HEADING = 2, GYROSTAT_NEEDS_TRUTH = 4 };

typedef struct gyrostat_filter {
  const char* name;  /* letters, digits and _: how studies and tables call it */
  const char* title; /* one line for people */
  uint32_t corrects; /* a gyrostat_corrects: what it is compared as */
  uint32_t needs;    /* of gyrostat_needs */
  uint32_t parameter_count;
  const gyrostat_parameter* parameters;

  /* A filter at its start. `values` are in the order of `parameters` and gone afterwards. NULL: it cannot be made. */
  void* (*create)(const double* values);
  /* The next `count` samples of one trial. `steps` are missing throughout, with status 0. However samples are cut
   * into blocks, the same steps come out: step i knows samples 0 to i alone. */
  void (*step)(void* filter, const gyrostat_sample* samples, gyrostat_step* steps, size_t count);
  void (*destroy)(void* filter);
} gyrostat_filter;

/* ---- Sensor effects ---- */

/* Where in the chain an effect acts. It may change the channels named here; changes of others are not seen. */
enum gyrostat_stage {
  GYROSTAT_ENVIRONMENT = 0, /* temperature_C, rate_ref_dps */
  GYROSTAT_SENSING = 1,     /* thermal_bias_dps */
  GYROSTAT_NOISE = 2,       /* gyro_dps, which holds rate, drift, random error and white noise alone */
  GYROSTAT_ELECTRONICS = 3, /* gyro_dps, the analogue signal */
  GYROSTAT_CONVERSION = 4,  /* gyro_dps, at the converter */
  GYROSTAT_TRANSPORT = 5,   /* gyro_dps, behind it */
  GYROSTAT_COMPASS = 6      /* heading_deg, before its own noise and its wrapping */
};

enum gyrostat_channel {
  GYROSTAT_T_S,
  GYROSTAT_GYRO_DPS,
  GYROSTAT_TEMPERATURE_C,
  GYROSTAT_HEADING_DEG,
  GYROSTAT_MAG_VALID, /* 1 where the compass may be used, 0 where it is disturbed */
  GYROSTAT_RATE_REF_DPS,
  GYROSTAT_ACC_X_MPS2,
  GYROSTAT_ACC_Y_MPS2,
  GYROSTAT_ACC_Z_MPS2,
  GYROSTAT_CROSS_RATE_1_DPS,
  GYROSTAT_CROSS_RATE_2_DPS,
  GYROSTAT_THERMAL_BIAS_DPS,
  GYROSTAT_RANDOM_ERROR_DPS,
  GYROSTAT_CHANNELS
};

/* A trial's signal on its way through the chain: t_s, what the effect needs and what its stage changes, `count`
 * values each; NULL for any other channel. */
typedef struct gyrostat_signal {
  size_t count;
  double* channel[GYROSTAT_CHANNELS];
} gyrostat_signal;

/* The trial's noise: deviates at addresses, the same whenever and wherever they are asked for, and no draw of any
 * other effect. `stream` names one of the effect's sequences; use one kind of deviate a stream. */
typedef struct gyrostat_noise {
  const void* address;
  void (*normals)(const void* address, const char* stream, uint64_t first, double* out, size_t count);
  void (*uniforms)(const void* address, const char* stream, uint64_t first, double* out, size_t count);
} gyrostat_noise;

typedef struct gyrostat_effect {
  const char* name;
  const char* title;
  uint32_t stage; /* a gyrostat_stage */
  uint32_t needs; /* 1u << GYROSTAT_…: without one of these channels the effect is not applied */
  uint32_t parameter_count;
  const gyrostat_parameter* parameters;
  const double* absent; /* values of the parameters at which it changes no bit */

  /* A function of values, signal and noise alone. */
  void (*apply)(const double* values, gyrostat_signal* signal, const gyrostat_noise* noise);
} gyrostat_effect;

/* ---- The library ---- */

typedef struct gyrostat_plugin {
  uint32_t abi; /* GYROSTAT_PLUGIN_ABI */
  uint32_t filter_count;
  uint32_t effect_count;
  const gyrostat_filter* filters;
  const gyrostat_effect* effects;
} gyrostat_plugin;

/* Defined by the plug-in. */
const gyrostat_plugin* gyrostat_describe(void);

#ifdef __cplusplus
}
#endif

#endif
