#include <gyrostat/experiments/findings/application.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/error_series.hpp>
#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/write_columns.hpp>

namespace gyrostat {
namespace {

Track from_sample(const Track& track, std::size_t first) {
  Track rest = track;
  const auto cut_head = [&](auto& column) {
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(first));
  };
  cut_head(rest.estimate_dps);
  cut_head(rest.estimate_variance);
  cut_head(rest.innovation_dps);
  cut_head(rest.innovation_variance);
  cut_head(rest.status);
  return rest;
}

/// Clusters of one sample and of whole decades of seconds, as long as the deviation is defined.
std::vector<std::size_t> decade_clusters(const Series& series) {
  std::vector<std::size_t> clusters = {1};
  for (double tau_s = 0.01; tau_s <= series.duration_s() / 5.0; tau_s *= 10.0) {
    const auto cluster = static_cast<std::size_t>(std::llround(tau_s * series.rate_hz()));
    if (cluster > clusters.back()) clusters.push_back(cluster);
  }
  return clusters;
}

Table statistics_table(const Series& judged, const std::vector<Track>& tracks,
                       const std::vector<Method>& methods, const std::string& title) {
  Table table{.title = title + ": raw (none) against compensated rate",
              .columns = {{"method", ""},
                          {"mean", "dps"},
                          {"std", "dps"},
                          {"RMSE", "dps"},
                          {"heading end", "deg"},
                          {"heading range", "deg"},
                          {"NIS", "1"},
                          {"log score", "nat"},
                          {"breakdown steps", ""}}};
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const TrackErrors errors = track_errors(judged, tracks[m]);
    const auto counts = tracks[m].status_counts();
    std::int64_t breakdowns = 0;
    for (std::size_t s = 0; s < counts.size(); ++s)
      if (is_breakdown(static_cast<Status>(s))) breakdowns += counts[s];
    table.rows.push_back(
        {methods[m].id, cell(errors.rate.mean), cell(errors.rate.std), cell(errors.rate.rmse),
         errors.heading.end_deg, errors.heading.max_deg - errors.heading.min_deg,
         cell(errors.innovations.nis), cell(errors.innovations.log_score), breakdowns});
  }
  table.notes.push_back(judged.rate_ref_dps.empty()
                            ? "no rate_ref_dps: the gyro counts as static, so all rate is error"
                            : "rate error against rate_ref_dps");
  table.notes.push_back(
      "a small std alone proves little, a gain near one removes motion as well; the log "
      "score, small for who foretells the next sample well, cannot be cheated so");
  return table;
}

Table allan_table(const Series& judged, const std::vector<Track>& tracks,
                  const std::vector<Method>& methods, const std::string& title) {
  Table table{.title = title + ": overlapping Allan deviation, raw (none) against compensated",
              .columns = {{"method", ""}}};
  const auto clusters = decade_clusters(judged);
  for (const std::size_t cluster : clusters)
    table.columns.push_back(
        {fmt::format("tau {:.4g} s", static_cast<double>(cluster) / judged.rate_hz()), "dps"});
  for (std::size_t m = 0; m < methods.size(); ++m) {
    auto& row = table.rows.emplace_back();
    row.emplace_back(methods[m].id);
    const auto error = bridged_rate_errors_dps(judged, tracks[m]);
    for (const auto& point : overlapping_allan_deviation(error, judged.rate_hz(), clusters))
      row.emplace_back(point.deviation);
  }
  return table;
}

}  // namespace

std::vector<Method> read_application_config(const std::string& path) {
  Mistakes mistakes;
  const Json json = read_json(path, &mistakes);
  JsonObject object(json, path + ":", &mistakes);
  auto methods = read_methods(object, "filters", ParameterSource::defaults);
  object.finish();
  mistakes.raise();
  if (methods.empty()) throw InputError(path, "\"filters\" is missing or empty");
  return methods;
}

Application calibrated(const Series& series, double fraction, FitMethod method) {
  const auto samples = static_cast<std::size_t>(fraction * static_cast<double>(series.size()));
  Application application;
  application.calibration = calibrate(series.slice(0, samples), method);
  application.judged_from_s = series.t_s[samples] - series.t_s.front();
  return application;
}

void apply_methods(const std::vector<Method>& methods, const Series& series, std::ostream& log,
                   Application& application) {
  ParameterMap parameters;
  if (application.calibration) {
    const double start_C = series.temperature_C.empty() ? no_value : series.temperature_C.front();
    parameters = parameters_from(*application.calibration, start_C);
  }
  std::vector<std::string> left_out;
  for (const auto& method : methods) {
    const auto& filter = method.type();
    const auto missing = missing_channels(filter.needs, series);
    if (!missing.empty()) {
      left_out.push_back(
          fmt::format("{} left out: the recording has no {}", method.id, fmt::join(missing, ", ")));
      continue;
    }
    try {
      Track track;
      run_filter(filter, parameters, method.overrides, series, track);
      application.tracks.push_back(std::move(track));
      application.methods.push_back(method);
    } catch (const std::runtime_error& failure) {  // of a filter that is not ours
      left_out.push_back(fmt::format("{} left out: {}", method.id, failure.what()));
    }
  }
  if (application.methods.empty())
    throw InputError("no method can run", fmt::format("{}", fmt::join(left_out, "; ")));
  for (const auto& line : left_out) log << line << '\n';
}

std::vector<Table> application_tables(const Series& series, const Application& application,
                                      const std::string& name) {
  const Series judged = cut(series, application.judged_from_s, 1e18, name);
  std::vector<Track> tracks;
  for (const auto& track : application.tracks)
    tracks.push_back(from_sample(track, series.size() - judged.size()));
  const auto title = fmt::format("{} from {:.4g} s", name, application.judged_from_s);
  return {statistics_table(judged, tracks, application.methods, title),
          allan_table(judged, tracks, application.methods, title)};
}

void write_application(const std::filesystem::path& path, const Series& series,
                       const Application& application) {
  std::vector<std::vector<std::string_view>> statuses;
  for (const auto& track : application.tracks) {
    auto& names = statuses.emplace_back();
    for (const Status status : track.status) names.push_back(name_of(status));
  }
  std::vector<CsvColumn> columns = {{"t_s", series.t_s, {}}, {"raw_dps", series.gyro_dps, {}}};
  for (std::size_t m = 0; m < application.methods.size(); ++m) {
    const auto& id = application.methods[m].id;
    const auto& track = application.tracks[m];
    columns.push_back({id + "_estimate_dps", track.estimate_dps, {}});
    columns.push_back({id + "_innovation_dps", track.innovation_dps, {}});
    columns.push_back({id + "_innovation_variance", track.innovation_variance, {}});
    columns.push_back({id + "_status", {}, statuses[m]});
  }
  write_columns(path, columns);
}

}  // namespace gyrostat
