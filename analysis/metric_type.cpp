#include <gyrostat/analysis/metric_type.hpp>

namespace gyrostat {

std::size_t metric_named(std::string_view name, std::string_view place) {
  const auto& wanted = metric_types().named(name, place);
  std::size_t index = 0;
  while (&metric_types()[index] != &wanted) ++index;
  return index;
}

}  // namespace gyrostat
