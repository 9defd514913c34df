#include <gyrostat/diagnosis/gap/scene.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/gap/recorders_way.hpp>
#include <gyrostat/diagnosis/gap/spectral_bands.hpp>

namespace gyrostat::gap {
namespace {

Spectrum spectrum_of(const std::vector<double>& values, const std::vector<Span>& spans,
                     double rate_hz) {
  const std::size_t length = segment_length(spans);
  if (length == 0) return {};
  std::vector<std::span<const double>> stretches;
  std::size_t segments = 0;
  for (const auto& span : spans) {
    stretches.push_back(std::span(values).subspan(span.first, span.size()));
    segments += span.size() / length;
  }
  return welch(stretches, rate_hz, length, segments < 32 ? length / 2 : length);
}

/// Takes out of `heading`, without its mean, by how far the recorder's way of sampling it is from
/// ours.
void align(const Conditions& conditions, std::vector<double>& heading) {
  const auto& rate = conditions.series().rate_ref_dps;
  const auto over_valid = [&](auto&& add) {
    for (const auto& span : conditions.spans(Part::train))
      for (std::size_t i = span.first; i < span.last; ++i)
        if (!is_missing(heading[i])) add(i);
  };
  double sum = 0.0, count = 0.0, product = 0.0, square = 0.0;
  over_valid([&](std::size_t i) { sum += rate[i], count += 1.0; });
  const double mean = count > 0.0 ? sum / count : 0.0;
  over_valid([&](std::size_t i) {
    product += heading[i] * (rate[i] - mean);
    square += (rate[i] - mean) * (rate[i] - mean);
  });
  if (square == 0.0) return;
  const double interval_s = conditions.interval_s();
  const double lag = interval_s * way_of_recorders(product / square / interval_s);
  for (std::size_t i = 0; i < heading.size(); ++i) heading[i] -= lag * (rate[i] - mean);
}

/// Takes out what slow values, in the middle of each cluster, say by linear interpolation.
void remove_slow(const std::vector<double>& slow, std::size_t cluster,
                 std::vector<double>& values) {
  if (slow.empty()) return;
  const auto last = static_cast<double>(slow.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double at =
        std::clamp((static_cast<double>(i) + 0.5) / static_cast<double>(cluster) - 0.5, 0.0, last);
    const auto low = std::min(static_cast<std::size_t>(at), slow.size() - 1);
    const auto high = std::min(low + 1, slow.size() - 1);
    values[i] -= slow[low] + (slow[high] - slow[low]) * (at - static_cast<double>(low));
  }
}

std::vector<double> heading_error(const Conditions& conditions, const Series& series) {
  const auto& valid = conditions.series().mag_valid;
  const auto& turned = conditions.turned_deg();
  std::vector<double> error(conditions.size(), no_value);
  double sine = 0.0, cosine = 0.0;
  constexpr double rad = std::numbers::pi / 180.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (!valid.empty() && valid[i] == 0.0) continue;
    error[i] = series.heading_deg[i] - (turned.empty() ? 0.0 : turned[i]);
  }
  // The circular mean of a hundredth of the samples is enough to unwrap by.
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; i += 17)
      if (!is_missing(error[i])) {
        sine += std::sin(error[i] * rad);
        cosine += std::cos(error[i] * rad);
      }
  const double centre = std::atan2(sine, cosine) / rad;
  double sum = 0.0;
  std::size_t count = 0;
  for (auto& value : error) value = wrap_degrees(value - centre);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(error[i])) {
        sum += error[i];
        ++count;
      }
  const double mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
  for (auto& value : error) value -= mean;
  if (conditions.has_motion()) align(conditions, error);
  return error;
}

}  // namespace

std::size_t segment_length(std::span<const Span> spans) {
  constexpr std::size_t longest_segment = 4096, shortest_segment = 32;
  std::size_t longest = 0;
  for (const auto& span : spans) longest = std::max(longest, span.size());
  const std::size_t length = std::min(longest_segment, std::bit_floor(longest));
  return length < shortest_segment ? 0 : length;
}

void Scene::reduce_rate(const Conditions& conditions, const Series& series) {
  const auto& reference = conditions.series().rate_ref_dps;
  rate_error_dps = series.gyro_dps;
  if (!reference.empty())
    for (std::size_t i = 0; i < rate_error_dps.size(); ++i) rate_error_dps[i] -= reference[i];
  conditions.bridge(rate_error_dps);

  slow_dps = conditions.slow_means(rate_error_dps);
  drift = conditions.drift_of(slow_dps);
  const auto slow_drift = conditions.drift(drift);
  for (std::size_t k = 0; k < slow_dps.size(); ++k) slow_dps[k] -= slow_drift[k];
  remove_slow(slow_drift, conditions.cluster(), rate_error_dps);
}

Scene::Scene(const Conditions& conditions, const Series& series, std::span<const Part> of)
    : recorded_dps(series.gyro_dps) {
  const bool rate = !series.gyro_dps.empty();
  const bool heading = conditions.has_heading() && !series.heading_deg.empty();
  if (rate) reduce_rate(conditions, series);
  if (heading) {
    heading_error_deg = heading_error(conditions, series);
    slow_heading_deg = conditions.slow_means(heading_error_deg);
  }
  for (const Part part : of) {
    const auto& fast = conditions.spans(part);
    const auto& slow = conditions.slow_spans(part);
    const auto at = index_of(part);
    if (heading) heading_octaves[at] = gap::octaves(slow_heading_deg, slow);
    if (!rate) continue;
    octaves[at] = gap::octaves(rate_error_dps, fast);
    slow_octaves[at] = gap::octaves(slow_dps, slow);
    spectra[at] = spectrum_of(rate_error_dps, fast, conditions.rate_hz());
    slow_spectra[at] = spectrum_of(slow_dps, slow, 1.0 / conditions.slow_interval_s());
  }
}

}  // namespace gyrostat::gap
