#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/vibration_bursts.hpp>

namespace gyrostat::gap {

/// The highest peak of the spectrum, in stretches that have it and in others.
template <>
struct Diagnosed<effects::VibrationBursts> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {
      &effects::VibrationBursts::std_dps, &effects::VibrationBursts::centre_hz,
      &effects::VibrationBursts::bandwidth_hz, &effects::VibrationBursts::mean_duration_s,
      &effects::VibrationBursts::mean_interval_s};

  /// A block has it where its power about the peak is more than halfway, in decibels, from the
  /// median block's to the strongest's.
  static std::vector<Start> starts(const Evidence& e) {
    const auto peak = highest_peak(e.scene.spectra[0]);
    if (peak.frequency_hz <= 0.0 || peak.power <= 0.0) return {};
    const double block_s = blocks_s(peak);
    const auto powers = block_powers(e, peak.frequency_hz, block_s);
    const double usual = quantile(powers, 0.5), most = quantile(powers, 0.999);
    if (!(most > 4.0 * usual)) return {};
    const double threshold = std::sqrt(usual * most);
    double with = 0.0, begun = 0.0;
    for (std::size_t k = 0; k < powers.size(); ++k) {
      with += powers[k] > threshold;
      begun += powers[k] > threshold && (k == 0 || powers[k - 1] <= threshold);
    }
    const auto all = static_cast<double>(powers.size());
    if (begun < 1.0 || with == all) return {};
    const double white = e.baseline.random_error.measurement_noise_std_dps;
    const double rest = std::max(0.1 * white * white, white * white - peak.power);
    return {{effects::VibrationBursts{std::sqrt(peak.power * all / with), peak.frequency_hz,
                                      0.5 * peak.width_hz, block_s * with / begun,
                                      block_s * (all - with) / begun},
             with_white(e, std::sqrt(rest))}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::time(c); }

  /// Bursts that are longer than the vibration remembers, and that a recording has several of.
  static bool is_what_it_is_called(const effects::VibrationBursts& effect, const Conditions& c) {
    const double duration_s = c.interval_s() * static_cast<double>(c.size());
    return effect.bandwidth_hz < 0.5 * effect.centre_hz &&
           effect.mean_duration_s * effect.bandwidth_hz > 1.0 &&
           effect.mean_duration_s < effect.mean_interval_s &&
           effect.mean_duration_s + effect.mean_interval_s < 0.2 * duration_s;
  }

 private:
  /// As long as the vibration remembers, and a period at least.
  static double blocks_s(const SpectralPeak& peak) {
    return std::max(1.0 / peak.width_hz, 2.0 / peak.frequency_hz);
  }

  /// Power about a frequency, block after block of the train part.
  static std::vector<double> block_powers(const Evidence& e, double frequency_hz, double block_s) {
    const auto& c = e.conditions();
    const auto block = static_cast<std::size_t>(std::max(8.0, block_s * c.rate_hz()));
    const double turn = -2.0 * std::numbers::pi * frequency_hz * c.interval_s();
    std::vector<double> powers;
    for (const auto& span : c.spans(Part::train))
      for (std::size_t at = span.first; at + block <= span.last; at += block) {
        std::complex<double> sum = 0.0;
        for (std::size_t i = at; i < at + block; ++i)
          sum += std::polar(e.scene.rate_error_dps[i], turn * static_cast<double>(i));
        powers.push_back(std::norm(sum));
      }
    return powers;
  }
};

}  // namespace gyrostat::gap
