// Filters that do what no filter should, for plugins_test: one library, a filter for each misdeed;
// and one of those that hang, which cost time (HANGS). A trial is struck where its first sample is
// above zero, which is a function of the trial.
#include <gyrostat/experiments/plugins/gyrostat_plugin.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <unistd.h>

namespace {

struct Mean {
  double gain, mean = 0.0;
  std::size_t seen = 0;
  bool is_struck = false;
};

void* create(const double* values) { return new Mean{.gain = 1.0 / values[0]}; }
void destroy(void* filter) { delete static_cast<Mean*>(filter); }

template <class Misdeed>
void step(void* filter, const gyrostat_sample* samples, gyrostat_step* steps, std::size_t count) {
  auto& self = *static_cast<Mean*>(filter);
  for (std::size_t i = 0; i < count; ++i) {
    if (self.seen++ == 0) self.is_struck = samples[i].gyro_dps > 0.0;
    if (!std::isnan(samples[i].gyro_dps))
      self.mean += self.gain * (samples[i].gyro_dps - self.mean);
    steps[i].estimate_dps = self.mean;
    if (self.is_struck && self.seen == 300) Misdeed::commit(steps[i]);
  }
}

struct None {
  static void commit(gyrostat_step&) {}
};
struct Crash {
  static void commit(gyrostat_step&) { std::raise(SIGSEGV); }
};
struct Hang {
  static void commit(gyrostat_step&) {
    for (;;) ::pause();
  }
};
struct NotFinite {
  static void commit(gyrostat_step& step) { step.estimate_dps = NAN; }
};
struct Chatter {
  static void commit(gyrostat_step&) {
    std::puts("a line that a filter prints while it is debugged");
    std::fflush(stdout);
  }
};

/// Remembers across trials.
[[maybe_unused]] void remembering(void*, const gyrostat_sample* samples, gyrostat_step* steps,
                                  std::size_t count) {
  static double mean = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isnan(samples[i].gyro_dps)) mean += 0.02 * (samples[i].gyro_dps - mean);
    steps[i].estimate_dps = mean;
  }
}

/// One state for all instances, reset by each that is made.
double only_mean = 0.0;
[[maybe_unused]] void* create_only(const double*) {
  only_mean = 0.0;
  return &only_mean;
}
[[maybe_unused]] void step_only(void*, const gyrostat_sample* samples, gyrostat_step* steps,
                                std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isnan(samples[i].gyro_dps)) only_mean += 0.02 * (samples[i].gyro_dps - only_mean);
    steps[i].estimate_dps = only_mean;
  }
}
[[maybe_unused]] void keep(void*) {}

/// Knows the samples of its block that are still to come.
[[maybe_unused]] void foreseeing(void*, const gyrostat_sample* samples, gyrostat_step* steps,
                                 std::size_t count) {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    sum += std::isnan(samples[i].gyro_dps) ? 0.0 : samples[i].gyro_dps;
  for (std::size_t i = 0; i < count; ++i) steps[i].estimate_dps = sum / static_cast<double>(count);
}

/// Another answer each time.
[[maybe_unused]] void whimsical(void*, const gyrostat_sample*, gyrostat_step* steps,
                                std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) steps[i].estimate_dps = 1e-9 * ::getpid();
}

const gyrostat_parameter memory[] = {
    {"time_constant", "samples", "memory of the mean", 1.0, INFINITY, 50.0, 0}};

#define FILTER(name, make, step, end) \
  { name, "for tests: " name, GYROSTAT_RANDOM_ERROR, 0, 1, memory, make, step, end }
const gyrostat_filter filters[] = {
#ifdef HANGS
    FILTER("hanging", create, step<Hang>, destroy),
#else
    FILTER("sound", create, step<None>, destroy),
    FILTER("crashing", create, step<Crash>, destroy),
    FILTER("not_finite", create, step<NotFinite>, destroy),
    FILTER("chatting", create, step<Chatter>, destroy),
    FILTER("remembering", create, remembering, destroy),
    FILTER("alone", create_only, step_only, keep),
    FILTER("foreseeing", create, foreseeing, destroy),
    FILTER("whimsical", create, whimsical, destroy),
#endif
};

const gyrostat_parameter size[] = {{"size_dps", "dps", "of what is added", 0.0, 1.0, 0.1, 0}};
const double zero[] = {0.0};

/// Is there even where it should be absent, and in no two trials of a process alike.
void lasting(const double* values, gyrostat_signal* signal, const gyrostat_noise*) {
  static double trials = 0.0;
  trials += 1.0;
  for (std::size_t i = 0; i < signal->count; ++i)
    signal->channel[GYROSTAT_GYRO_DPS][i] += values[0] + 1e-6 * trials;
}

/// Ends in trials whose first sample is above zero.
void ending(const double*, gyrostat_signal* signal, const gyrostat_noise*) {
  if (signal->channel[GYROSTAT_GYRO_DPS][0] > 0.0) ::_exit(7);
}

const gyrostat_effect effects[] = {
    {"lasting", "for tests: lasting", GYROSTAT_ELECTRONICS, 1U << GYROSTAT_GYRO_DPS, 1, size, zero,
     lasting},
    {"ending", "for tests: ending", GYROSTAT_ELECTRONICS, 1U << GYROSTAT_GYRO_DPS, 1, size, zero,
     ending},
};

const gyrostat_plugin plugin = {GYROSTAT_PLUGIN_ABI, sizeof filters / sizeof *filters,
                                sizeof effects / sizeof *effects, filters, effects};

}  // namespace

const gyrostat_plugin* gyrostat_describe(void) { return &plugin; }
