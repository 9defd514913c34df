#include <gyrostat/diagnosis/likelihood/line_track.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/likelihood/frequency_track.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_blocks = 8, shortest_block = 16;

/// Powers of two, from `least` on.
std::vector<std::size_t> block_lengths(const Conditions& conditions, double least) {
  std::vector<std::size_t> lengths;
  for (std::size_t length = shortest_block; length * fewest_blocks <= conditions.size();
       length *= 2)
    if (static_cast<double>(length) >= least) lengths.push_back(length);
  return lengths;
}

/// Of a sine in one bin, over the noise's there.
std::vector<double> power_of(const BlockPowers& blocks, double amplitude_dps) {
  std::vector<double> power;
  for (const double noise : blocks.noise_dps2)
    power.push_back(0.25 * amplitude_dps * amplitude_dps * static_cast<double>(blocks.length) /
                    noise);
  return power;
}

LineTrack track_in_blocks(const Conditions& conditions, const std::vector<double>& left,
                          const NoiseLaw& noise, const Resonance& band, std::size_t length) {
  constexpr double reach = 3.0;  // of its wander
  constexpr std::array<double, 3> of_half_bandwidth = {0.7, 1.2, 2.0};
  constexpr std::array<double, 5> memories = {1.0, 3.0, 10.0, 30.0, 100.0};
  constexpr std::array<double, 5> of_amplitude = {0.7, 0.85, 1.0, 1.15, 1.3};
  // What moves through more bins from one block to the next stands in none within one.
  constexpr double farthest = 2.0;
  LineTrack best;
  const double half_hz = 0.5 * band.bandwidth_hz;
  const double resolution_hz = conditions.rate_hz() / static_cast<double>(length);
  std::vector<Wandering> ways;
  for (const double share : of_half_bandwidth)
    for (const double memory : memories) {
      const Wandering way{band.centre_hz, share * half_hz, memory};
      if (way.step_hz() <= farthest * resolution_hz) ways.push_back(way);
    }
  if (ways.empty()) return best;
  const auto blocks = block_powers(conditions, left, noise, length, band.centre_hz,
                                   reach * of_half_bandwidth.back() * half_hz);
  if (blocks.bins() < 3 || blocks.told() < fewest_blocks) return best;
  NoiseLaw with = noise;
  with.resonances.push_back(band);
  auto of_band = density_of(with, Angles(length / 2 + 1));
  of_band.erase(of_band.begin(), of_band.begin() + static_cast<std::ptrdiff_t>(blocks.first));
  of_band.resize(blocks.bins());
  for (std::size_t k = 0; k < of_band.size(); ++k)
    of_band[k] *= 0.5 * conditions.rate_hz() / blocks.noise_dps2[k];
  const double band_over_noise = blocks.log_gain_of(of_band);
  const double amplitude_dps = std::sqrt(2.0 * band.variance);
  const auto keep = [&](const Wandering& wandering, const FrequencyTrack& track, double amplitude) {
    const auto power = power_of(blocks, amplitude);
    const double gain = track.log_gain(power);
    const double over_band =
        gain - std::max(band_over_noise, blocks.log_gain_of(track.spectrum(power)));
    if (over_band > best.over_band)
      best = {over_band,
              gain,
              {amplitude, wandering.centre_hz, wandering.std_hz,
               wandering.memory_blocks * blocks.interval_s}};
  };
  for (const auto& way : ways) keep(way, {blocks, way}, amplitude_dps);
  if (best.over_band == 0.0) return best;
  const Wandering wandering{best.line.frequency_hz, best.line.wander_hz,
                            best.line.correlation_time_s / blocks.interval_s};
  const FrequencyTrack track(blocks, wandering);
  for (const double share : of_amplitude) keep(wandering, track, share * amplitude_dps);
  return best;
}

}  // namespace

LineTrack track_in_band(const Conditions& conditions, const std::vector<double>& left_dps,
                        const NoiseLaw& noise, const Resonance& band) {
  // In blocks that are shorter than its memory, noise of the band is alike from one to the next.
  const auto lengths = block_lengths(
      conditions, conditions.rate_hz() / (std::numbers::pi * std::max(band.bandwidth_hz, 1e-9)));
  std::vector<LineTrack> tracks(lengths.size());
  tbb::parallel_for(std::size_t{0}, lengths.size(), [&](std::size_t k) {
    tracks[k] = track_in_blocks(conditions, left_dps, noise, band, lengths[k]);
  });
  LineTrack best;
  for (const auto& track : tracks)
    if (track.over_band > best.over_band) best = track;
  return best;
}

std::optional<Resonance> band_of_hidden_line(const Conditions& conditions,
                                             const std::vector<double>& left_dps,
                                             const NoiseLaw& noise, double least,
                                             double highest_hz) {
  constexpr std::array<double, 2> steps_in_bins = {0.3, 1.2};
  constexpr std::array<double, 5> powers = {0.5, 1.0, 2.0, 4.0, 8.0};
  struct Found {
    double gain = 0.0;
    Resonance band{};
  };
  const auto lengths = block_lengths(conditions, 2.0 * shortest_block);
  std::vector<Found> each(lengths.size());
  tbb::parallel_for(std::size_t{0}, lengths.size(), [&](std::size_t l) {
    // Below, what is left of a level that was taken out is no noise of the law.
    const double lowest_hz = std::min(conditions.rate_hz() / 32.0, 0.5 * highest_hz);
    const auto blocks =
        block_powers(conditions, left_dps, noise, lengths[l], 0.5 * (lowest_hz + highest_hz),
                     0.5 * (highest_hz - lowest_hz));
    if (blocks.told() < fewest_blocks) return;
    auto& found = each[l];
    found.gain = least;
    for (const double step : steps_in_bins) {
      const FrequencyTrack track(blocks, Wandering::anywhere(step * blocks.resolution_hz));
      for (const double power : powers) {
        const std::vector<double> in_each(blocks.bins(), power);
        const double gain = track.log_gain(in_each);
        if (gain <= found.gain) continue;
        const auto seen = track.seen(in_each);
        const auto bin =
            static_cast<std::size_t>(std::lround(seen.centre_hz / blocks.resolution_hz));
        const double there_dps2 =
            blocks.noise_dps2[std::min(bin - std::min(bin, blocks.first), blocks.bins() - 1)];
        found = {gain,
                 {2.0 * power * there_dps2 / static_cast<double>(blocks.length), seen.centre_hz,
                  2.0 * seen.std_hz}};
      }
    }
  });
  std::optional<Resonance> best;
  double most = least;
  for (const auto& found : each)
    if (found.gain > most) {
      most = found.gain;
      best = found.band;
    }
  return best;
}

}  // namespace gyrostat::gap
