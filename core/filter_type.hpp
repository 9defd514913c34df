#pragma once

#include <deque>
#include <span>
#include <string_view>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/parameter_map.hpp>
#include <gyrostat/core/registry.hpp>
#include <gyrostat/core/track.hpp>

namespace gyrostat {

/// A filter without its C++ type.
struct FilterType {
  static constexpr std::string_view kind = "filter";

  std::string_view id, title;
  Needs needs;
  Role role;
  bool draws_noise = false;
  std::span<const FieldInfo> fields;
  /// Runs it from its start over every sample of a series; `parameters` are in the order of
  /// `fields`.
  void (*run)(std::span<const double> parameters, const Series& series, Track& track) = nullptr;

  static void describe_all(std::deque<FilterType>& to);
};

inline Registry<FilterType>& filter_types() { return Registry<FilterType>::all(); }

/// The description of a filter template under a name. A program that describes and adds one of its
/// own has it in its studies:
///
///   gyrostat::filter_types().add(gyrostat::describe_filter<MyFilter>("mine"));
template <template <class> class F>
requires Filter<F<double>> FilterType describe_filter(std::string_view id) {
  using Parameters = typename F<double>::Parameters;
  return {.id = id,
          .title = F<double>::title,
          .needs = F<double>::needs,
          .role = F<double>::role,
          .draws_noise = draws_noise<F<double>>,
          .fields = field_infos_of<Parameters>,
          .run = [](std::span<const double> values, const Series& series, Track& track) {
            Parameters p;
            std::size_t i = 0;
            for (const auto& field : Parameters::fields()) p.*(field.member) = values[i++];
            run_filter(F<double>(p), series, track);
          }};
}

/// A filter's parameters in the order of its fields: its defaults, but where `told` names one, and
/// before that `overrides`.
std::vector<double> field_values(const FilterType& filter, const ParameterMap& told,
                                 const ParameterMap& overrides = {});

/// Runs the filter over the series into `track`, whose memory is reused. Parameters that it does
/// not have concern other filters.
void run_filter(const FilterType& filter, const ParameterMap& told, const ParameterMap& overrides,
                const Series& series, Track& track);

}  // namespace gyrostat
