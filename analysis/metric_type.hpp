#pragma once

#include <concepts>
#include <deque>
#include <string>
#include <string_view>

#include <gyrostat/analysis/goal.hpp>
#include <gyrostat/core/registry.hpp>

namespace gyrostat {

struct Series;
struct Track;
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

  /// In the place of `value`: of all that a method made of a series, as it is judged.
  double (*of_track)(const Series& series, const Track& track, std::size_t member) = nullptr;

  bool needs_track() const { return of_track != nullptr; }
  double operator()(const TrackErrors& errors) const { return value(errors, member); }
  double operator()(const Series& series, const Track& track) const {
    return of_track(series, track, member);
  }

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

/// A metric that sums do not tell asks for the whole track, by operator()(series, track): tracks
/// are then made, which a study without such a metric is spared.
template <class M>
concept OfTrack = requires(const Series& series, const Track& track) {
  M{}(series, track);
}
|| requires(const Series& series, const Track& track) { M{}(series, track, std::size_t{}); };

/// Appends the metric, or the members of a family: `pit` as pit_0, pit_1, … with their number,
/// from 1, in the place of {} in the title.
template <Metric M>
void describe_metric(std::string_view id, std::deque<MetricType>& to) {
  MetricType type{
      .id = std::string(id), .title = std::string(M::title), .unit = M::unit, .goal = M::goal};
  if constexpr (requires { M::table; }) type.table = M::table;
  if constexpr (requires { M::members; }) {
    if constexpr (OfTrack<M>)
      type.of_track = [](const Series& series, const Track& track, std::size_t member) {
        return M{}(series, track, member);
      };
    else
      type.value = [](const TrackErrors& errors, std::size_t member) {
        return M{}(errors, member);
      };
    const auto number = M::title.find("{}");
    for (; type.member < M::members; ++type.member) {
      type.id = std::string(id) + "_" + std::to_string(type.member);
      type.title = std::string(M::title).replace(number, 2, std::to_string(type.member + 1));
      to.push_back(type);
    }
  } else {
    if constexpr (OfTrack<M>)
      type.of_track = [](const Series& series, const Track& track, std::size_t) {
        return M{}(series, track);
      };
    else
      type.value = [](const TrackErrors& errors, std::size_t) { return M{}(errors); };
    to.push_back(std::move(type));
  }
}

}  // namespace gyrostat
