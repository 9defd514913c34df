#include <gyrostat/analysis/error_series.hpp>

#include <gyrostat/analysis/errors.hpp>

namespace gyrostat {

std::vector<double> heading_errors_deg(const Series& series, const Track& track) {
  std::vector<double> heading(series.size());
  for (std::size_t i = 1; i < heading.size(); ++i) {
    const double e = rate_error_dps(series, track, i);
    heading[i] = heading[i - 1] + (std::isnan(e) ? 0.0 : e * (series.t_s[i] - series.t_s[i - 1]));
  }
  return heading;
}

std::vector<double> bridged_rate_errors_dps(const Series& series, const Track& track) {
  std::vector<double> error(series.size());
  double last = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double e = rate_error_dps(series, track, i);
    if (!std::isnan(e)) last = e;
    error[i] = last;
  }
  return error;
}

}  // namespace gyrostat
