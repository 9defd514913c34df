#include <gyrostat/diagnosis/likelihood/silent_zone.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// By how much outputs are less than the rate in its own direction, about the bias that shows with
/// one sign in one direction and with the other in the other.
struct Lost {
  double dps, bias_dps, noise_dps;
};

Lost lost_beyond(const std::vector<double>& forth, const std::vector<double>& back) {
  const double one = quantile(forth, 0.5), other = quantile(back, 0.5);
  std::vector<double> off;
  for (const double x : forth) off.push_back(std::abs(x - one));
  for (const double x : back) off.push_back(std::abs(x - other));
  return {0.5 * (one + other), 0.5 * (other - one), quantile(off, 0.5) / normal_quartile};
}

}  // namespace

SilentZone silent_zone(const Conditions& conditions, const std::vector<double>& z, double lsb_dps) {
  constexpr std::size_t fewest = 20;
  constexpr double beside = 5.0;  // times as often as the values next to it
  const auto& reference = conditions.series().rate_ref_dps;
  if (reference.empty()) return {};
  std::vector<double> at_zero, beyond;
  double zeros = 0.0, next = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (is_missing(z[i])) continue;
      if (z[i] == 0.0) {
        zeros += 1.0;
        if (reference[i] != 0.0) at_zero.push_back(std::abs(reference[i]));
      } else {
        beyond.push_back(std::abs(z[i]));
      }
      if (lsb_dps > 0.0 && std::abs(std::abs(z[i]) - lsb_dps) < 0.1 * lsb_dps) next += 0.5;
    }
  if (at_zero.size() < fewest || beyond.size() < fewest || zeros < beside * next) return {};
  // Zeros that say that nothing was measured come at any rate.
  const double reach_dps = quantile(at_zero, 0.9), least_dps = *std::ranges::min_element(beyond);
  double within = 0.0, silent = 0.0;
  std::vector<double> forth, back;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (is_missing(z[i])) continue;
      const double size = std::abs(reference[i]);
      if (size < 0.5 * reach_dps) {
        within += 1.0;
        silent += z[i] == 0.0 ? 1.0 : 0.0;
      } else if (size > 1.5 * reach_dps && size < 5.0 * reach_dps) {
        if (reference[i] > 0.0)
          forth.push_back(reference[i] - z[i]);
        else
          back.push_back(z[i] - reference[i]);
      }
    }
  constexpr double nearly_all = 0.8;
  if (within < static_cast<double>(fewest) || silent < nearly_all * within ||
      forth.size() < fewest || back.size() < fewest)
    return {};
  const auto lost = lost_beyond(forth, back);
  const bool takes_off = least_dps < 0.5 * reach_dps;
  SilentZone zone{.half_width_dps = takes_off ? lost.dps : least_dps,
                  .lost_beyond = takes_off ? 1.0 : 0.0};
  if (!(zone.half_width_dps > 0.0)) return {};
  constexpr double beyond_noise = 6.0;
  const double near = zone.half_width_dps + beyond_noise * lost.noise_dps;
  zone.samples.assign(z.size(), 0);
  for (std::size_t i = 0; i < z.size(); ++i)
    zone.samples[i] = z[i] == 0.0 || std::abs(reference[i] + lost.bias_dps) < near ? 1 : 0;
  return zone;
}

}  // namespace gyrostat::gap
