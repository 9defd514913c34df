#pragma once

#include <map>
#include <string>

#include <gyrostat/core/fields.hpp>

namespace gyrostat {

/// Parameter values by field name.
using ParameterMap = std::map<std::string, double, std::less<>>;

/// Sets those parameters of `p` that `values` names and leaves the rest; values without a field in
/// `p` concern other filters.
template <class P>
void set_parameters(P& p, const ParameterMap& values) {
  for (const auto& field : P::fields())
    if (const auto value = values.find(field.name); value != values.end())
      p.*(field.member) = value->second;
}

/// The parameters of `p`, by name.
template <class P>
ParameterMap parameter_values(const P& p) {
  ParameterMap values;
  for (const auto& field : P::fields()) values[std::string(field.name)] = p.*(field.member);
  return values;
}

}  // namespace gyrostat
