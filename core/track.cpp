#include <gyrostat/core/track.hpp>

namespace gyrostat {
namespace {

double value_at(const std::vector<double>& channel, std::size_t i) {
  return channel.empty() ? no_value : channel[i];
}

}  // namespace

void Track::resize(std::size_t samples) {
  estimate_dps.resize(samples);
  estimate_variance.resize(samples);
  innovation_dps.resize(samples);
  innovation_variance.resize(samples);
  status.resize(samples);
}

std::array<std::uint32_t, status_names.size()> Track::status_counts() const {
  std::array<std::uint32_t, status_names.size()> counts{};
  for (const Status s : status) ++counts[static_cast<std::size_t>(s)];
  return counts;
}

Sample<double> sample_at(const Series& series, std::size_t i) {
  const bool disturbed = !series.mag_valid.empty() && series.mag_valid[i] != 1.0;
  return {.t_s = series.t_s[i],
          .gyro_dps = series.gyro_dps[i],
          .temperature_C = value_at(series.temperature_C, i),
          .heading_deg = disturbed ? no_value : value_at(series.heading_deg, i),
          .true_rate_dps = value_at(series.rate_ref_dps, i),
          .true_drift_dps = value_at(series.thermal_bias_dps, i)};
}

std::vector<std::string> missing_channels(const Needs& needs, const Series& series) {
  std::vector<std::string> missing;
  const auto require = [&](bool needed, const std::vector<double>& channel, const char* name) {
    if (needed && channel.empty()) missing.emplace_back(name);
  };
  require(needs.temperature, series.temperature_C, "temperature_C");
  require(needs.heading, series.heading_deg, "heading_deg");
  require(needs.truth, series.rate_ref_dps, "rate_ref_dps");
  require(needs.truth, series.thermal_bias_dps, "thermal_bias_dps");
  return missing;
}

}  // namespace gyrostat
