#pragma once

#include <string>
#include <vector>

#include <gyrostat/analysis/search/box_search.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

/// Where a method's parameters come from, before its own overrides.
enum class ParameterSource { defaults, calibration, truth };

/// A filter under a name, with the parameters that the user fixed.
struct Method {
  std::string id;
  std::string filter;
  ParameterSource source = ParameterSource::calibration;
  ParameterMap overrides;
  std::map<std::string, SearchRange> tune;  ///< parameters to be tuned, with their bounds

  /// Of its filter; throws InputError at `place` where there is none of that name.
  const FilterType& type(std::string_view place) const {
    return filter_types().named(filter, place);
  }
  const FilterType& type() const { return type(id); }
  const Role& role() const { return type().role; }
};

/// Methods from a list of filter names or objects {"id", "filter", "parameters_from",
/// "parameters", "tune"}. Throws InputError for unknown filters and keys, values out of range, and
/// an id that stands twice.
std::vector<Method> read_methods(JsonObject& object, const std::string& key,
                                 ParameterSource default_source);

/// Every filter under its own name, "none" first and "oracle" last; those by simulation, which are
/// slow, only run where they are named.
std::vector<Method> all_methods(ParameterSource source);

/// A name that can stand in a table, a column head and a file: throws InputError at `place` for an
/// empty one, and for line breaks, quotes and other control characters.
std::string plain_name(std::string name, const std::string& place);

/// The source called `name`; throws InputError at `place` otherwise.
ParameterSource parameter_source_named(const std::string& name, const std::string& place);

}  // namespace gyrostat
