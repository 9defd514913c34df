#include <gyrostat/diagnosis/transfer.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/track.hpp>
#include <gyrostat/diagnosis/simulator.hpp>
#include <gyrostat/generators/true_parameters.hpp>

namespace gyrostat::gap {
namespace {

constexpr double random_error_s = 120.0;
constexpr std::size_t metrics = 4;
constexpr std::array<std::pair<std::string_view, std::string_view>, metrics> metric_names = {
    std::pair{"innovation_std", "dps"}, std::pair{"nis", "1"},
    std::pair{"compensated_allan_deviation_1s", "dps"},
    std::pair{"heading_drift_against_compass", "deg"}};

/// The filters of both studies, in their order.
std::vector<const FilterType*> published_filters() {
  std::vector<const FilterType*> filters;
  for (const auto& filter : filter_types())
    if (filter.role.published > 0) filters.push_back(&filter);
  std::sort(filters.begin(), filters.end(), [](const FilterType* a, const FilterType* b) {
    return std::pair(a->role.corrects, a->role.published) <
           std::pair(b->role.corrects, b->role.published);
  });
  return filters;
}

double allan_deviation_1s(const std::vector<double>& rate, double rate_hz) {
  const auto cluster = static_cast<std::size_t>(std::max(1.0, std::round(rate_hz)));
  double square = 0.0, count = 0.0, previous = no_value;
  for (std::size_t first = 0; first + cluster <= rate.size(); first += cluster) {
    double mean = 0.0;
    for (std::size_t i = first; i < first + cluster; ++i)
      mean += rate[i] / static_cast<double>(cluster);
    if (!is_missing(mean - previous)) {
      square += 0.5 * (mean - previous) * (mean - previous);
      count += 1.0;
    }
    previous = mean;
  }
  return count > 0.0 ? std::sqrt(square / count) : no_value;
}

/// Change of (integrated compensated rate - compass), from the first to the last tenth.
double heading_drift(const Series& series, const std::vector<double>& compensated) {
  if (series.heading_deg.empty()) return no_value;
  const std::size_t n = series.size();
  double angle = 0.0, first = 0.0, last = 0.0, in_first = 0.0, in_last = 0.0, previous = 0.0,
         turns = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && !is_missing(compensated[i]))
      angle += compensated[i] * (series.t_s[i] - series.t_s[i - 1]);
    if (is_missing(series.heading_deg[i])) continue;
    double error = angle - series.heading_deg[i] + turns;
    const double jump = 360.0 * std::round((error - previous) / 360.0);
    turns -= jump;
    error -= jump;
    previous = error;
    if (i < n / 10) first += error, in_first += 1.0;
    if (i >= n - n / 10) last += error, in_last += 1.0;
  }
  return in_first > 0.0 && in_last > 0.0 ? last / in_last - first / in_first : no_value;
}

using Values = std::array<double, metrics>;

Values values_of(const Series& series, const Track& track) {
  double square = 0.0, nis = 0.0, count = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double nu = track.innovation_dps[i];
    if (is_missing(nu) || !(track.innovation_variance[i] > 0.0)) continue;
    square += nu * nu;
    nis += nu * nu / track.innovation_variance[i];
    count += 1.0;
  }
  std::vector<double> compensated(series.size());
  for (std::size_t i = 0; i < series.size(); ++i)
    compensated[i] = series.gyro_dps[i] - track.estimate_dps[i];
  const double n = std::max(count, 1.0);
  return {count > 0 ? std::sqrt(square / n) : no_value, count > 0 ? nis / n : no_value,
          allan_deviation_1s(compensated, series.rate_hz()), heading_drift(series, compensated)};
}

ParameterMap parameters_of(const Scenario& scenario, const Series& recording) {
  ParameterMap values = true_parameters(scenario);
  double level = scenario.thermal_drift.c_dps;
  if (!recording.temperature_C.empty())
    level += scenario.thermal_drift.a_dps_per_C * recording.temperature_C.front();
  values["initial_x_dps"] = values["initial_x_previous_dps"] = level;
  values["initial_x_std_dps"] = values["initial_x_previous_std_dps"] =
      std::max(0.1 * scenario.random_error.measurement_noise_std_dps, 1e-9);
  return values;
}

/// One entry a filter.
std::vector<Values> all_values(const std::vector<const FilterType*>& filters,
                               const ParameterMap& parameters, const Series& series,
                               const Interrupt& interrupt) {
  std::vector<Values> all(filters.size());
  const auto begun = static_cast<std::size_t>(random_error_s * series.rate_hz());
  const Series beginning =
      series.slice(0, std::min(series.size(), std::max<std::size_t>(begun, 2)));
  Track track;
  for (std::size_t f = 0; f < filters.size(); ++f) {
    interrupt.check();
    all[f].fill(no_value);
    const bool is_thermal = filters[f]->role.corrects == Role::Corrects::thermal_drift;
    const Series& seen = is_thermal ? series : beginning;
    if (!missing_channels(filters[f]->needs, seen).empty()) continue;
    run_filter(*filters[f], parameters, {}, seen, track);
    all[f] = values_of(seen, track);
  }
  return all;
}

/// `changes` are those of each replica: both scenarios draw the same noise.
Moved moved(const Transfer& row, const std::vector<double>& changes) {
  const auto n = static_cast<double>(changes.size());
  const double mean = row.after - row.before;
  double square = 0.0;
  for (const double change : changes) square += (change - mean) * (change - mean);
  const double chance = student_t_two_sided(0.95, n - 1.0) * std::sqrt(square / (n * (n - 1.0)));
  const double nearer = std::abs(row.before - row.real) - std::abs(row.after - row.real);
  return nearer > chance ? Moved::closer : nearer < -chance ? Moved::away : Moved::nowhere;
}

}  // namespace

std::string_view name_of(Moved moved) {
  return moved == Moved::closer ? "closer" : moved == Moved::away ? "away" : "nowhere";
}

std::vector<Transfer> transfer(const Simulator& simulator, const Series& recording,
                               const Scenario& before, const Scenario& after,
                               std::size_t replicas) {
  const auto parameters = parameters_of(before, recording);
  const auto filters = published_filters();
  const auto& interrupt = simulator.interrupt();
  const auto real = all_values(filters, parameters, recording, interrupt);
  std::vector<std::vector<Values>> sims(2 * replicas);
  tbb::parallel_for(std::size_t{0}, sims.size(), [&](std::size_t k) {
    const auto& scenario = k < replicas ? before : after;
    sims[k] = all_values(filters, parameters,
                         simulator.replica(scenario, static_cast<std::uint32_t>(k % replicas)),
                         interrupt);
  });
  std::vector<Transfer> rows;
  for (std::size_t f = 0; f < filters.size(); ++f)
    for (std::size_t m = 0; m < metrics; ++m) {
      if (is_missing(real[f][m])) continue;
      Transfer row{std::string(filters[f]->id),
                   std::string(metric_names[m].first),
                   std::string(metric_names[m].second),
                   real[f][m],
                   0.0,
                   0.0};
      // Signs of a drift are chance; its size is what is promised.
      const bool size = metric_names[m].first == "heading_drift_against_compass";
      if (size) row.real = std::abs(row.real);
      std::vector<double> changes;
      const auto value = [&](std::size_t k) {
        return size ? std::abs(sims[k][f][m]) : sims[k][f][m];
      };
      for (std::size_t k = 0; k < replicas; ++k) {
        row.before += value(k) / static_cast<double>(replicas);
        row.after += value(replicas + k) / static_cast<double>(replicas);
        changes.push_back(value(replicas + k) - value(k));
      }
      row.moved = moved(row, changes);
      rows.push_back(row);
    }
  return rows;
}

}  // namespace gyrostat::gap
