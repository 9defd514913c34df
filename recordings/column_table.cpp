#include <gyrostat/recordings/column_table.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

void ColumnTable::add(std::string name, std::vector<double> column) {
  names.push_back(std::move(name));
  values.push_back(std::move(column));
}

void ColumnTable::take(std::span<std::vector<double>* const> targets, const std::string& place) {
  const auto first = std::ranges::find_if(targets, [](const auto* target) { return target; });
  const auto reference = static_cast<std::size_t>(first - targets.begin());
  const auto length = first == targets.end() ? 0 : values[reference].size();
  std::size_t infinite = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!targets[i]) continue;
    if (values[i].size() != length)
      throw InputError(place, fmt::format("'{}' has {} values, '{}' has {}; allowed: equally many",
                                          names[i], values[i].size(), names[reference], length));
    for (double& value : values[i])
      if (std::isinf(value)) {
        value = no_value;
        ++infinite;
      }
  }
  if (infinite > 0) notes.push_back(fmt::format("{} infinite values taken as missing", infinite));
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (targets[i]) *targets[i] = std::move(values[i]);
}

}  // namespace gyrostat
