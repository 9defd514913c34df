#include <gyrostat/experiments/findings/models/covering.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/law_allan.hpp>
#include <gyrostat/diagnosis/likelihood/set_fit.hpp>
#include <gyrostat/generators/effects/outliers.hpp>

namespace gyrostat {
namespace {

/// Averaging times and what the Allan variance is there beside white noise and the walk.
struct Curve {
  std::vector<double> tau_s, beside;
};

constexpr double too_small = 1.05;

std::vector<std::size_t> clusters_up_to(double averaging_s, double rate_hz) {
  const double longest = std::max(1.0, averaging_s * rate_hz * (1.0 + 1e-9));
  std::vector<std::size_t> clusters = {1};
  for (double m = 1.0; m <= longest; m *= 1.0905077326652577)  // eight an octave
    if (const auto whole = static_cast<std::size_t>(m); whole > clusters.back())
      clusters.push_back(whole);
  if (const auto last = static_cast<std::size_t>(longest); last > clusters.back())
    clusters.push_back(last);
  return clusters;
}

Cover cover_of(const SensorModel& model, const Curve& curve, std::string because) {
  Cover cover{.because = std::move(because)};
  const double n2 = model.N.value * model.N.value, k2 = model.K.value * model.K.value;
  double most_k = k2;
  for (std::size_t i = 0; i < curve.tau_s.size(); ++i) {
    const double tau = curve.tau_s[i];
    const double factor = std::sqrt(std::max(1.0, 1.0 + tau * curve.beside[i] / n2));
    cover.factor_of_N = std::max(cover.factor_of_N, factor);
    if (factor > too_small) cover.up_to_s = tau;
    most_k = std::max(most_k, k2 + 3.0 * curve.beside[i] / tau);
  }
  cover.factor_of_K = k2 > 0.0 ? std::sqrt(most_k / k2) : 0.0;
  return cover;
}

/// What an effect adds, at every averaging time; nothing where it has no Allan variance.
Curve added_by(const Effect& effect, const SensorModel& model,
               const std::vector<std::size_t>& clusters) {
  Scenario alone = model.scenario;
  alone.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  alone.effects = {effect};
  auto law = gap::law_of(alone, 1.0 / model.rate_hz);
  if (const auto* outliers = effect.as<effects::Outliers>())
    (outliers->before_filter > 0.5 ? law.white : law.rounding) +=
        outliers->probability * outliers->std_dps * outliers->std_dps;
  Curve curve;
  for (const auto m : clusters) {
    curve.tau_s.push_back(static_cast<double>(m) / model.rate_hz);
    curve.beside.push_back(gap::allan_variance(law, m));
  }
  return curve;
}

}  // namespace

std::vector<Cover> covers(const SensorModel& model, const std::vector<std::string>& left_out,
                          double averaging_s) {
  std::vector<Cover> found;
  const auto keep = [&](Cover cover) {
    if (cover.factor_of_N > 1.005) found.push_back(std::move(cover));
  };
  if (!(model.N.value > 0.0)) return found;
  if (!model.measured.empty()) {
    Curve curve;
    for (const auto& point : model.measured) {
      if (point.tau_s > averaging_s * (1.0 + 1e-9)) break;
      curve.tau_s.push_back(point.tau_s);
      curve.beside.push_back(point.deviation * point.deviation -
                             model.N.value * model.N.value / point.tau_s -
                             model.K.value * model.K.value * point.tau_s / 3.0);
    }
    keep(cover_of(model, curve, "what the recording's Allan deviation shows beside N and K"));
    return found;
  }
  const auto clusters = clusters_up_to(averaging_s, model.rate_hz);
  Curve all;
  std::string names;
  for (const auto& effect : model.scenario.effects) {
    if (std::find(left_out.begin(), left_out.end(), effect.id()) == left_out.end()) continue;
    const auto curve = added_by(effect, model, clusters);
    if (all.tau_s.empty()) all = {curve.tau_s, std::vector<double>(curve.tau_s.size(), 0.0)};
    for (std::size_t i = 0; i < curve.beside.size(); ++i) all.beside[i] += curve.beside[i];
    auto cover = cover_of(model, curve, std::string(effect.id()));
    if (cover.factor_of_N > 1.005) names += (names.empty() ? "" : " and ") + cover.because;
    keep(std::move(cover));
  }
  if (found.size() > 1) keep(cover_of(model, all, names + " together"));
  return found;
}

}  // namespace gyrostat
