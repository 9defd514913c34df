// The same filter in C++, as a class; and an adapter that makes a plug-in of any such class.
#include <gyrostat_plugin.h>

#include <cmath>
#include <new>

namespace {

class LeakyMean {
 public:
  explicit LeakyMean(const double* values) : gain_(1.0 / values[0]) {}

  void step(const gyrostat_sample& sample, gyrostat_step& step) {
    const double innovation = sample.gyro_dps - mean_;
    if (std::isnan(innovation)) {
      step.status = GYROSTAT_NO_MEASUREMENT;
    } else {
      mean_ += gain_ * innovation;
      step.innovation_dps = innovation;
    }
    step.estimate_dps = mean_;
  }

 private:
  double gain_, mean_ = 0.0;
};

// No exception may leave a function of C's.
template <class Filter>
void* create(const double* values) {
  try {
    return new Filter(values);
  } catch (...) {
    return nullptr;
  }
}

template <class Filter>
void step(void* filter, const gyrostat_sample* samples, gyrostat_step* steps, size_t count) {
  for (size_t i = 0; i < count; ++i) static_cast<Filter*>(filter)->step(samples[i], steps[i]);
}

template <class Filter>
void destroy(void* filter) {
  delete static_cast<Filter*>(filter);
}

const gyrostat_parameter parameters[] = {
    {"time_constant", "samples", "memory of the mean", 1.0, INFINITY, 50.0, 0}};
const gyrostat_filter filter = {
    "cpp_mean",        "leaky mean, in C++", GYROSTAT_RANDOM_ERROR, 0, 1, parameters,
    create<LeakyMean>, step<LeakyMean>,      destroy<LeakyMean>};
const gyrostat_plugin plugin = {GYROSTAT_PLUGIN_ABI, 1, 0, &filter, nullptr};

}  // namespace

const gyrostat_plugin* gyrostat_describe(void) { return &plugin; }
