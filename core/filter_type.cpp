#include <gyrostat/core/filter_type.hpp>

namespace gyrostat {

std::vector<double> field_values(const FilterType& filter, const ParameterMap& told,
                                 const ParameterMap& overrides) {
  std::vector<double> values;
  for (const auto& field : filter.fields) {
    double value = field.value;
    for (const auto* given : {&told, &overrides})
      if (const auto found = given->find(field.name); found != given->end()) value = found->second;
    values.push_back(value);
  }
  return values;
}

void run_filter(const FilterType& filter, const ParameterMap& told, const ParameterMap& overrides,
                const Series& series, Track& track) {
  filter.run(field_values(filter, told, overrides), series, track);
}

}  // namespace gyrostat
