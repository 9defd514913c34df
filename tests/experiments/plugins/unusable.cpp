// Libraries that cannot be plug-ins, for plugins_test. The reason is defined where it is compiled.
#include <gyrostat/experiments/plugins/gyrostat_plugin.h>

#include <cmath>
#include <csignal>

namespace {

void* create(const double*) { return nullptr; }
[[maybe_unused]] void step(void*, const gyrostat_sample*, gyrostat_step*, size_t) {}
void destroy(void*) {}

#ifdef DEFAULT_OUT_OF_RANGE
constexpr double by_default = 0.5;
#else
constexpr double by_default = 2.0;
#endif
const gyrostat_parameter parameters[] = {{"gain", "1", "a gain", 1.0, INFINITY, by_default, 0}};

const gyrostat_filter filter = {
#if defined(NAME_TAKEN)
    "kf",
#elif defined(NAME_UNFIT)
    "my filter",
#else
    "unusable",
#endif
    "for tests: cannot be used",
    GYROSTAT_RANDOM_ERROR,
    0,
    1,
    parameters,
    create,
#ifdef STEP_MISSING
    nullptr,
#else
    step,
#endif
    destroy};

const gyrostat_plugin plugin = {
#ifdef OTHER_ABI
    GYROSTAT_PLUGIN_ABI + 6,
#else
    GYROSTAT_PLUGIN_ABI,
#endif
    1, 0, &filter, nullptr};

}  // namespace

#ifndef SYMBOL_MISSING
const gyrostat_plugin* gyrostat_describe(void) {
#ifdef CRASHES
  std::raise(SIGSEGV);
#endif
  return &plugin;
}
#else
extern "C" const void* something_else(void) { return &plugin; }
#endif
