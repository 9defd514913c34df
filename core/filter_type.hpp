#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/parameter_map.hpp>
#include <gyrostat/core/registry.hpp>
#include <gyrostat/core/running_filter.hpp>
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
  /// `fields`. Called from many threads at once.
  std::function<void(std::span<const double> parameters, const Series& series, Track& track)> run{};
  /// The same stretch by stretch; null for a filter that is given whole series.
  std::unique_ptr<RunningFilter> (*start)(std::span<const double> parameters) = nullptr;
  /// Tells its code from another under the same name; empty for code of the program itself.
  std::string code{};

  static void describe_all(std::deque<FilterType>& to);
};

inline Registry<FilterType>& filter_types() { return Registry<FilterType>::all(); }

template <template <class> class F>
std::unique_ptr<RunningFilter> start_filter(std::span<const double> values) {
  typename F<double>::Parameters p;
  std::size_t i = 0;
  for (const auto& field : p.fields()) p.*(field.member) = values[i++];
  return std::make_unique<RunningOf<F<double>>>(F<double>(p));
}

/// The description of a filter template under a name. A program that describes and adds one of its
/// own has it in its studies, beside those of gyrostat.
///
/// Example: a filter that takes the first sample for the gyro's error.
///
///   #include <gyrostat/core/models/no_parameters.hpp>
///
///   template <class T>
///   class Hold {
///    public:
///     using Scalar = T;
///     using Parameters = NoParameters<T>;
///     static constexpr std::string_view title = "holds the first sample";
///     static constexpr Needs needs{};
///     static constexpr Role role{};
///
///     explicit Hold(const Parameters& /*none*/) {}
///
///     Step<T> step(const Sample<T>& sample) {
///       if (is_missing(first_)) first_ = sample.gyro_dps;
///       return {.estimate_dps = is_missing(first_) ? T(0.0) : first_};
///     }
///
///    private:
///     T first_{no_value};
///   };
///
///   filter_types().add(describe_filter<Hold>("hold"));
///
/// Thread safety: `add` is for the start of a program (Registry). A filter is copied for each
/// trial, so its own members are seen by one thread alone.
template <template <class> class F>
requires Filter<F<double>> FilterType describe_filter(std::string_view id) {
  using Parameters = typename F<double>::Parameters;
  return {.id = id,
          .title = F<double>::title,
          .needs = F<double>::needs,
          .role = F<double>::role,
          .draws_noise = draws_noise<F<double>>,
          .fields = field_infos_of<Parameters>,
          .run =
              [](std::span<const double> values, const Series& series, Track& track) {
                const auto filter = start_filter<F>(values);
                run_to_the_end(*filter, series, track);
              },
          .start = &start_filter<F>};
}

/// A filter's parameters in the order of its fields: its defaults, but where `told` names one, and
/// before that `overrides`.
std::vector<double> field_values(const FilterType& filter, const ParameterMap& told,
                                 const ParameterMap& overrides = {});

/// Runs the filter over the series into `track`, whose memory is reused. Parameters that it does
/// not have concern other filters.
///
/// Example: the Kalman filter by its name, with its defaults but for phi.
///
///   Series series;
///   synthesise(Scenario{}, {.seed = 1, .trial = 0}, series);
///   Track track;
///   run_filter(filter_types().named("kf", "example"), {{"phi", 0.3}}, {}, series, track);
///
/// Thread safety: may run in any number of threads at once, each with a `track` of its own.
void run_filter(const FilterType& filter, const ParameterMap& told, const ParameterMap& overrides,
                const Series& series, Track& track);

}  // namespace gyrostat
