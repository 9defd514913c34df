#include "experiments/metric_names.hpp"

#include "analysis/metrics/list.hpp"

namespace gyrostat {
namespace {

template <class Text>
std::string of_metric(std::size_t metric, const Text& text) {
  std::string found;
  std::size_t m = 0;
  Metrics::for_each([&](auto plugin) {
    if (m++ == metric) found = text(typename decltype(plugin)::type{});
  });
  return found;
}

}  // namespace

std::string metric_title(std::size_t metric) {
  return of_metric(metric, [](auto type) { return type.title; });
}

std::string metric_unit(std::size_t metric) {
  return of_metric(metric, [](auto type) { return type.unit; });
}

}  // namespace gyrostat
