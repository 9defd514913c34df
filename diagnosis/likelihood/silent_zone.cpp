#include <gyrostat/diagnosis/likelihood/silent_zone.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_values = 20;

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

/// What the train part has at zero and elsewhere.
struct Values {
  std::vector<double> rates_at_zero;  ///< absolute
  std::vector<double> beyond;         ///< absolute, sorted

  double least() const { return beyond.front(); }
  double below(double size) const {
    return static_cast<double>(std::ranges::lower_bound(beyond, size) - beyond.begin());
  }
};

template <class Do>
void each_known(const Conditions& conditions, const std::vector<double>& z, const Do& act) {
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(z[i])) act(i);
}

/// Flags what is written as 0, and where the rate sensed lies nearer than that.
std::vector<char> flagged(const std::vector<double>& z, const std::vector<double>& reference,
                          double bias_dps, double near_dps) {
  std::vector<char> samples(z.size(), 0);
  for (std::size_t i = 0; i < z.size(); ++i)
    samples[i] = z[i] == 0.0 || std::abs(reference[i] + bias_dps) < near_dps ? 1 : 0;
  return samples;
}

constexpr double beyond_noise = 6.0;  // standard deviations

/// Where nearly all outputs are 0 as long as the rate is small.
SilentZone beyond_the_noise(const Conditions& conditions, const std::vector<double>& z,
                            const Values& values) {
  const auto& reference = conditions.series().rate_ref_dps;
  std::vector<double> turning;
  for (const double rate : values.rates_at_zero)
    if (rate != 0.0) turning.push_back(rate);
  if (turning.size() < fewest_values) return {};
  // Zeros that say that nothing was measured come at any rate.
  const double reach_dps = quantile(turning, 0.9);
  double within = 0.0, silent = 0.0;
  std::vector<double> forth, back;
  each_known(conditions, z, [&](std::size_t i) {
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
  });
  constexpr double nearly_all = 0.8;
  if (within < static_cast<double>(fewest_values) || silent < nearly_all * within ||
      forth.size() < fewest_values || back.size() < fewest_values)
    return {};
  const auto lost = lost_beyond(forth, back);
  const bool takes_off = values.least() < 0.5 * reach_dps;
  SilentZone zone{.half_width_dps = takes_off ? lost.dps : values.least(),
                  .lost_beyond = takes_off ? 1.0 : 0.0};
  if (!(zone.half_width_dps > 0.0)) return {};
  zone.samples =
      flagged(z, reference, lost.bias_dps, zone.half_width_dps + beyond_noise * lost.noise_dps);
  return zone;
}

/// Where the noise carries most outputs across: of the values in the zone hardly any are left, or,
/// where larger ones are drawn in, as many as beside.
SilentZone within_the_noise(const Conditions& conditions, const std::vector<double>& z,
                            const Values& values, double grid_dps) {
  const auto& reference = conditions.series().rate_ref_dps;
  const auto zeros = static_cast<double>(values.rates_at_zero.size());
  // A threshold that moves by a fifth of itself leaves as many.
  constexpr double hardly = 0.08;
  const auto left = static_cast<std::size_t>(hardly * zeros);
  if (left < 4 || left >= values.beyond.size()) return {};
  const double edge = values.beyond[left];
  constexpr double many = 0.35;
  const bool takes_off = values.below(2.0 * edge) < many * zeros;
  constexpr double as_it_is_written = 0.7;  // of the edge, where nothing moves the threshold
  SilentZone zone{.half_width_dps = takes_off                                  ? edge / hardly
                                    : values.least() > as_it_is_written * edge ? values.least()
                                                                               : edge,
                  .lost_beyond = takes_off ? 1.0 : 0.0};
  if (edge < 2.0 * grid_dps) return {};
  // At the quarter of the samples that turns least.
  std::vector<double> sizes, off;
  each_known(conditions, z, [&](std::size_t i) { sizes.push_back(std::abs(reference[i])); });
  const double slow_dps = quantile(sizes, 0.25);
  each_known(conditions, z, [&](std::size_t i) {
    if (z[i] != 0.0 && std::abs(reference[i]) <= slow_dps) off.push_back(z[i] - reference[i]);
  });
  if (off.size() < fewest_values) return {};
  const double bias_dps = quantile(off, 0.5);
  for (double& o : off) o = std::abs(o - bias_dps);
  const double noise_dps = quantile(off, 0.5) / normal_quartile;
  // A zone swallows about as many as are beside it, within the noise of its edge: more zeros are
  // of a grid.
  constexpr double many_more = 4.0;
  const double swallowed =
      (values.below(edge + noise_dps) - values.below(edge)) * zone.half_width_dps / noise_dps;
  if (!(zeros < many_more * swallowed)) return {};
  // Where few outputs are between rest and a table's speed, the edge is the least of them.
  constexpr double deep = 0.6, off_rest = 0.2;  // of the zone
  double heard = 0.0;
  each_known(conditions, z, [&](std::size_t i) {
    const double size = std::abs(reference[i] + bias_dps);
    if (size > off_rest * zone.half_width_dps &&
        size + beyond_noise * noise_dps < deep * zone.half_width_dps)
      heard += z[i] != 0.0 ? 1.0 : -1.0;
  });
  if (heard > 0.0) {
    if (values.least() < 2.0 * grid_dps) return {};
    zone = {.half_width_dps = values.least()};
  }
  const double near_dps = zone.half_width_dps + beyond_noise * noise_dps;
  if (quantile(values.rates_at_zero, 0.95) > std::abs(bias_dps) + near_dps) return {};
  zone.samples = flagged(z, reference, bias_dps, near_dps);
  // Where the rest is most of the recording, zeros pass for what they are not, by less than noise.
  constexpr double most_hidden = 0.5;
  if (static_cast<double>(std::ranges::count(zone.samples, char{1})) >
      most_hidden * static_cast<double>(z.size()))
    std::ranges::fill(zone.samples, char{0});
  return zone;
}

/// Where a motion that is sensed late goes through it, whatever the reference is then: there is
/// nothing between 0 and a value beyond which there are as many as there are zeros.
SilentZone beside_values(const Conditions& conditions, const std::vector<double>& z,
                         const Values& values, double grid_dps) {
  constexpr double fewest_beside = 50.0, alike = 2.0;
  const auto zeros = static_cast<double>(values.rates_at_zero.size());
  const double edge = values.least(), beside = values.below(2.0 * edge);
  if (edge < 2.0 * grid_dps || beside < fewest_beside || zeros > alike * beside ||
      beside > alike * zeros)
    return {};
  // What is curved by less than a motion's second difference is noise.
  std::vector<double> curved;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first + 2; i < span.last; ++i)
      if (const double second = z[i] - 2.0 * z[i - 1] + z[i - 2]; !is_missing(second))
        curved.push_back(std::abs(second));
  if (curved.empty()) return {};
  const double noise_dps = quantile(std::move(curved), 0.5) / (std::sqrt(6.0) * normal_quartile);
  SilentZone zone{.half_width_dps = edge, .samples = std::vector<char>(z.size(), 0)};
  for (std::size_t i = 0; i < z.size(); ++i)
    zone.samples[i] = std::abs(z[i]) < edge + beyond_noise * noise_dps ? 1 : 0;
  return zone;
}

}  // namespace

SilentZone silent_zone(const Conditions& conditions, const std::vector<double>& z,
                       double grid_dps) {
  constexpr double beside = 5.0;  // times as often as the values next to it
  const auto& reference = conditions.series().rate_ref_dps;
  if (reference.empty()) return {};
  Values values;
  double next = 0.0;
  each_known(conditions, z, [&](std::size_t i) {
    if (z[i] == 0.0)
      values.rates_at_zero.push_back(std::abs(reference[i]));
    else
      values.beyond.push_back(std::abs(z[i]));
    if (grid_dps > 0.0 && std::abs(std::abs(z[i]) - grid_dps) < 0.1 * grid_dps) next += 0.5;
  });
  const auto zeros = static_cast<double>(values.rates_at_zero.size());
  if (values.rates_at_zero.size() < fewest_values || values.beyond.size() < fewest_values ||
      zeros < beside * next)
    return {};
  std::ranges::sort(values.beyond);
  for (const auto& zone :
       {beyond_the_noise(conditions, z, values), within_the_noise(conditions, z, values, grid_dps)})
    if (zone.half_width_dps > 0.0) return zone;
  return beside_values(conditions, z, values, grid_dps);
}

}  // namespace gyrostat::gap
