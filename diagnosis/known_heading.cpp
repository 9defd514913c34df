#include <gyrostat/diagnosis/known_heading.hpp>

#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include <gyrostat/core/heading_turns.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

/// How long after the reference turned the heading does, by least squares with a level and a drift.
struct Lateness {
  double s;
  double error_s_per_deg;  ///< standard error beside noise of a degree
};
Lateness lateness_of(const Series& recording, const std::vector<double>& turned_deg) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d with = Eigen::Vector3d::Zero();
  double reference_deg = 0.0;
  for (std::size_t i = 1; i < turned_deg.size(); ++i) {
    const double rate = recording.rate_ref_dps[i], step_s = recording.t_s[i] - recording.t_s[i - 1];
    reference_deg += 0.5 * (rate + recording.rate_ref_dps[i - 1]) * step_s;
    if (is_missing(turned_deg[i])) continue;
    const Eigen::Vector3d row(1.0, recording.t_s[i] - recording.t_s[0], rate);
    normal += row * row.transpose();
    with += row * (reference_deg - turned_deg[i]);
  }
  const Eigen::LDLT<Eigen::Matrix3d> solved(normal);
  return {solved.solve(with)[2], std::sqrt(solved.solve(Eigen::Vector3d::UnitZ())[2])};
}

/// By what changes from sample to sample.
double heading_noise_deg(const Series& recording, const std::vector<double>& turned_deg) {
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 1; i < turned_deg.size(); ++i) {
    const double by = turned_deg[i] - turned_deg[i - 1] -
                      recording.rate_ref_dps[i] * (recording.t_s[i] - recording.t_s[i - 1]);
    if (is_missing(by)) continue;
    squares += by * by;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(0.5 * squares / count) : 0.0;
}

}  // namespace

Series with_known_heading(Series recording, std::vector<std::string>& told) {
  constexpr double forgotten = 8.0;  // a lag of so long has forgotten what was before
  constexpr double most_share = 0.05, clear = 3.0;
  auto& heading = recording.heading_deg;
  if (heading.empty() || recording.rate_ref_dps.empty()) return recording;
  const auto turned = unwrapped(heading);
  const auto [late_s, error_s_per_deg] = lateness_of(recording, turned);
  const double noise_deg = heading_noise_deg(recording, turned);
  const double until_s = recording.t_s.front() + forgotten * late_s;
  // Under one rate all the time it is not to be told from where the heading began.
  if (!(late_s > clear * error_s_per_deg * noise_deg) ||
      !(forgotten * late_s < most_share * recording.duration_s()) || !(noise_deg > 0.0) ||
      !(std::abs(recording.rate_ref_dps.front()) * late_s > clear * noise_deg))
    return recording;
  for (std::size_t i = 0; i < heading.size() && recording.t_s[i] < until_s; ++i)
    heading[i] = no_value;
  told.push_back(fmt::format(
      "the heading is {:.2g} s late, and the reference begins in motion: the first {:.2g} s of it "
      "are left out",
      late_s, forgotten * late_s));
  return recording;
}

}  // namespace gyrostat::gap
