#include <gyrostat/experiments/run/outcome_numbers.hpp>

#include <cmath>

#include <gyrostat/analysis/judge/kernels.hpp>
#include <gyrostat/analysis/metric_type.hpp>

namespace gyrostat {

double uncompensated_rmse(double count, double squares) {
  return count > 0.0 ? std::sqrt(squares / count) : no_value;
}

double uncompensated_rmse(const Series& series) {
  double sums[2] = {0.0, 0.0};
  const JudgedSteps all{.samples = series.size(),
                        .true_drift_dps = series.thermal_bias_dps.data(),
                        .random_error_dps = series.random_error_dps.data()};
  if (has_truth(series)) judge_kernel(1)->uncompensated(all, sums);
  return uncompensated_rmse(sums[0], sums[1]);
}

std::vector<double> numbers_of(const TrackErrors& errors, double uncompensated_dps, Made made) {
  std::vector<double> numbers;
  for (const auto& metric : metric_types()) {
    const double value = metric.needs_track() ? metric(*made.judged, *made.track) : metric(errors);
    numbers.push_back(std::isnan(value) ? no_value : value);
  }
  numbers.insert(numbers.end(), errors.steps.begin(), errors.steps.end());
  numbers.push_back(errors.bias.rmse > divergence_ratio * uncompensated_dps);
  return numbers;
}

}  // namespace gyrostat
