#include <gyrostat/experiments/pages/played.hpp>

#include <cmath>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/spectra/allan.hpp>

namespace gyrostat {

std::vector<double> Played::rate_errors_dps(std::size_t m) const {
  std::vector<double> errors(series.size());
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = rate_error_dps(series, tracks[m], i);
  return errors;
}

Played play(const Cell& plain, const CellResult& result, std::uint64_t seed, std::uint32_t trial,
            std::span<const std::size_t> methods) {
  const Cell cell = with_tuned(plain, result.tuned);
  Played played;
  Series buffer;
  make_trial(cell, seed, trial, played.series);
  const auto calibration = cell.calibration.each_trial && cell.needs_calibration()
                               ? calibrate_cell(cell, seed, trial, buffer)
                               : result.calibration;
  Scenario drawn;
  const auto& sensor = sensor_of(cell, {seed, trial}, drawn);
  for (const std::size_t m : methods) {
    const auto& method = cell.methods[m];
    played.ids.push_back(method.id);
    track_method(method, told_parameters(cell, sensor, method, calibration, played.series),
                 played.series, played.tracks.emplace_back());
  }
  return played;
}

std::vector<std::vector<double>> allan_deviations(const Played& played,
                                                  std::span<const double> taus_s) {
  std::vector<std::vector<double>> deviations;
  const double rate_hz = played.series.rate_hz();
  for (std::size_t m = 0; m < played.tracks.size(); ++m) {
    const auto errors = played.rate_errors_dps(m);
    auto& own = deviations.emplace_back();
    for (const double tau_s : taus_s) {
      const double samples = std::round(tau_s * rate_hz);
      own.push_back(no_value);
      if (!(samples >= 1.0) || samples > static_cast<double>(errors.size() / 2)) continue;
      const std::size_t cluster[] = {static_cast<std::size_t>(samples)};
      const auto points = overlapping_allan_deviation(errors, rate_hz, cluster);
      if (!points.empty()) own.back() = points.front().deviation;
    }
  }
  return deviations;
}

}  // namespace gyrostat
