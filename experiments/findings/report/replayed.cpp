#include <gyrostat/experiments/findings/report/replayed.hpp>

#include <algorithm>
#include <cmath>
#include <new>

#include <tbb/parallel_for.h>

#include <gyrostat/analysis/error_series.hpp>
#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/experiments/findings/cell_summary.hpp>
#include <gyrostat/experiments/findings/report/places.hpp>
#include <gyrostat/experiments/run/trial.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_replayed_points = 200;

/// What one method made of one trial, at the times and taus of the picture; empty where it threw.
struct Seen {
  std::vector<double> error, variance, heading, allan;
  double judged = no_value;  ///< the judging metric
};

Seen look(const Series& series, const Series& judged, const Track& track,
          const std::vector<std::size_t>& at) {
  const bool truth = has_truth(series);
  const auto heading = heading_errors_deg(judged, track);
  Seen seen;
  for (const std::size_t i : at) {
    seen.error.push_back(truth ? bias_error_dps(series, track, i) : track.innovation_dps[i]);
    seen.variance.push_back(truth ? track.estimate_variance[i] : track.innovation_variance[i]);
    seen.heading.push_back(heading[i]);
  }
  if (series.size() >= 8)
    for (const auto& point :
         overlapping_allan_deviation(bridged_rate_errors_dps(judged, track), judged.rate_hz()))
      seen.allan.push_back(point.deviation * point.deviation);
  return seen;
}

/// Mean and standard deviation over the trials in which the method has a value at place `i`.
ErrorMoments over_trials(const std::vector<const Seen*>& trials, std::vector<double> Seen::*values,
                         std::size_t i) {
  return error_moments(trials.size(), [&](std::size_t k) {
    const auto& all = trials[k]->*values;
    return i < all.size() ? all[i] : no_value;
  });
}

Replayed::Method folded(const std::vector<const Seen*>& trials, std::size_t times,
                        std::size_t taus) {
  Replayed::Method method;
  for (std::size_t i = 0; i < times; ++i) {
    const auto error = over_trials(trials, &Seen::error, i);
    method.error_mean.push_back(error.mean);
    method.error_std.push_back(error.std);
    method.stated_std.push_back(std::sqrt(over_trials(trials, &Seen::variance, i).mean));
    method.heading_rms.push_back(over_trials(trials, &Seen::heading, i).rmse);
  }
  for (std::size_t i = 0; i < taus; ++i) {
    const auto variance = over_trials(trials, &Seen::allan, i);
    method.allan_variance.push_back(variance.mean);
    method.allan_error.push_back(variance.std /
                                 std::sqrt(static_cast<double>(variance.count) - 1.0));
  }
  return method;
}

}  // namespace

std::uint32_t trials_to_replay(const Cell& cell) {
  const double samples =
      static_cast<double>(cell.scenario.sampling.samples() * cell.methods.size());
  return std::min(cell.trials, static_cast<std::uint32_t>(std::clamp(1e7 / samples, 2.0, 64.0)));
}

Replayed replay_trials(const PreparedCell& prepared, std::uint64_t seed, std::uint32_t trials) {
  const auto& cell = prepared.cell;
  Replayed replayed{
      .trials = trials, .truth = !cell.recording, .t_s = {}, .tau_s = {}, .methods = {}};
  Series first;
  make_trial(cell, seed, 0, first);
  const auto at = places(first.size(), most_replayed_points);
  for (const std::size_t i : at) replayed.t_s.push_back(first.t_s[i] - first.t_s.front());
  if (first.size() >= 8)
    for (const std::size_t cluster : allan_clusters(first.size()))
      replayed.tau_s.push_back(static_cast<double>(cluster) / first.rate_hz());

  const std::size_t judging = metric_named(judging_metric(cell), "report");
  std::vector<std::vector<Seen>> seen(trials, std::vector<Seen>(cell.methods.size()));
  tbb::parallel_for(std::uint32_t{0}, trials, [&](std::uint32_t trial) {
    Workspace w;
    make_trial(cell, seed, trial, w.series);
    const bool own = cell.calibration.each_trial && cell.needs_calibration();
    const auto calibration =
        own ? calibrate_cell(cell, seed, trial, w.calibration_series) : prepared.calibration;
    Scenario drawn;
    const auto& sensor = sensor_of(cell, {seed, trial}, drawn);
    const auto& judged = judged_series(cell, w.series, w.denoised);
    for (std::size_t m = 0; m < cell.methods.size(); ++m) try {
        const auto& method = cell.methods[m];
        track_method(method, told_parameters(cell, sensor, method, calibration, w.series), w.series,
                     w.track);
        seen[trial][m] = look(w.series, judged, w.track, at);
        seen[trial][m].judged = Outcome(judge_track(w.series, judged, w.track)).metric(judging);
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const std::exception&) {  // kept in quarantine by the run; here it is left out
      }
  });
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    std::vector<const Seen*> of_method;
    for (const auto& trial : seen) of_method.push_back(&trial[m]);
    replayed.methods.push_back(folded(of_method, at.size(), replayed.tau_s.size()));
    for (const auto* trial : of_method) replayed.methods.back().judged.push_back(trial->judged);
  }
  return replayed;
}

Comparison compare(const Replayed& replayed, const CellValues& stored) {
  Comparison comparison;
  for (std::size_t i = 0; i < stored.trials.size(); ++i) {
    const auto trial = stored.trials[i];
    if (trial >= replayed.trials) continue;
    for (std::size_t m = 0; m < replayed.methods.size(); ++m) {
      const double before = stored.values[m][i], again = replayed.methods[m].judged[trial];
      ++comparison.compared;
      comparison.different += before != again && !(std::isnan(before) && std::isnan(again));
    }
  }
  return comparison;
}

}  // namespace gyrostat
