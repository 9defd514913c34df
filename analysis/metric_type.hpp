#pragma once

#include <concepts>
#include <deque>
#include <string>
#include <string_view>

#include <gyrostat/analysis/goal.hpp>
#include <gyrostat/core/registry.hpp>

namespace gyrostat {

struct TrackErrors;

/// One number of a trial, without its C++ type.
struct MetricType {
  static constexpr std::string_view kind = "metric";

  std::string id, title;
  std::string_view unit;
  Goal goal = Goal::none;
  TableOf table{};
  std::size_t member = 0;  ///< of a family
  double (*value)(const TrackErrors& errors, std::size_t member) = nullptr;

  double operator()(const TrackErrors& errors) const { return value(errors, member); }

  static void describe_all(std::deque<MetricType>& to);
};

/// In the order in which outcomes have them.
inline Registry<MetricType>& metric_types() { return Registry<MetricType>::all(); }

/// The index of the metric called `name`; throws InputError at `place` otherwise.
std::size_t metric_named(std::string_view name, std::string_view place);

template <class M>
concept Metric = requires(const TrackErrors& errors) {
  { M::title } -> std::convertible_to<std::string_view>;
  { M::unit } -> std::convertible_to<std::string_view>;
  { M::goal } -> std::convertible_to<Goal>;
};

/// Appends the metric, or the members of a family: `pit` as pit_0, pit_1, … with their number,
/// from 1, in the place of {} in the title.
template <Metric M>
void describe_metric(std::string_view id, std::deque<MetricType>& to) {
  MetricType type{
      .id = std::string(id), .title = std::string(M::title), .unit = M::unit, .goal = M::goal};
  if constexpr (requires { M::table; }) type.table = M::table;
  if constexpr (requires { M::members; }) {
    type.value = [](const TrackErrors& errors, std::size_t member) { return M{}(errors, member); };
    const auto number = M::title.find("{}");
    for (; type.member < M::members; ++type.member) {
      type.id = std::string(id) + "_" + std::to_string(type.member);
      type.title = std::string(M::title).replace(number, 2, std::to_string(type.member + 1));
      to.push_back(type);
    }
  } else {
    type.value = [](const TrackErrors& errors, std::size_t) { return M{}(errors); };
    to.push_back(std::move(type));
  }
}

}  // namespace gyrostat
