#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/line_beside.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>
#include <gyrostat/generators/effects/scale_asymmetry.hpp>
#include <gyrostat/generators/effects/scale_factor.hpp>
#include <gyrostat/generators/effects/sensor_bandwidth.hpp>
#include <gyrostat/generators/effects/sinusoidal.hpp>

namespace gyrostat::gap {

/// The highest peaks of the spectrum, and of the periodogram of all samples; of each its frequency,
/// sharpened, is that of the largest amplitude over the train part.
template <>
struct Diagnosed<effects::Sinusoidal> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::Sinusoidal::amplitude_dps,
                                                 &effects::Sinusoidal::frequency_hz,
                                                 &effects::Sinusoidal::phase_deg};

  static std::vector<effects::Sinusoidal> starts(const Evidence& e) {
    const auto& conditions = e.conditions();
    std::vector<effects::Sinusoidal> found;
    const auto fast = below(e.scene.spectra[0], e.nyquist_hz);
    const auto& means = e.scene.slow_spectra[0];
    struct Near {
      double frequency_hz, reach_hz;
      bool slow;
    };
    const double of_fast = 1.5 * fast.resolution_hz;
    const auto highest = highest_peak(fast), narrow = highest_peak(fast, 1);
    std::vector<Near> peaks{{highest.frequency_hz, of_fast, false},
                            {highest_peak(means).frequency_hz, 1.5 * means.resolution_hz, true}};
    const auto is_new = [&](double frequency_hz) {
      return std::none_of(peaks.begin(), peaks.end(), [&](const Near& near) {
        return std::abs(near.frequency_hz - frequency_hz) < of_fast;
      });
    };
    // A line beside a hump that is higher, as of one that wanders.
    if (is_new(narrow.frequency_hz)) peaks.push_back({narrow.frequency_hz, of_fast, false});
    // One that no bin of the spectrum shows, in those of all samples.
    constexpr std::size_t around = 500;
    if (const double faint =
            clearest_line_hz(train_about_means(conditions, e.scene.rate_error_dps),
                             conditions.interval_s(), around, 0.25 / conditions.slow_interval_s());
        faint <= e.nyquist_hz && is_new(faint))
      peaks.push_back({faint, 1.0 / duration_s_of(conditions), false});
    for (const auto& [frequency_hz, reach, slow] : peaks) {
      if (frequency_hz <= 0.0) continue;
      const auto& values = slow ? e.scene.slow_dps : e.scene.rate_error_dps;
      const auto& spans = slow ? conditions.slow_spans(Part::train) : conditions.spans(Part::train);
      const double interval_s = slow ? conditions.slow_interval_s() : conditions.interval_s();
      const NearLine near(values, spans, frequency_hz, interval_s);
      const double step = std::max(0.3 / duration_s_of(conditions), reach / 600.0);
      double best = near.clearest_hz(frequency_hz - reach, frequency_hz + reach, step);
      double largest = std::abs(near.at(best));
      const double centre = best;
      for (double f = std::max(centre - step, 0.125 * step); f <= centre + step; f += 0.125 * step)
        if (const double a = std::abs(near.at(f)); a > largest) {
          largest = a;
          best = f;
        }
      keep(e, sine_at(e, best, slow), found);
    }
    // Under the set's own red noise, a line stands out in what cannot be foretold.
    if (const double best = clearest_line_hz(e.slow_innovations, conditions.slow_interval_s());
        best > 0.0)
      keep(e, sine_at(e, best, true), found);
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Sinusoidal& /*effect*/, const Conditions& /*c*/) {
    return true;
  }

 private:
  static double duration_s_of(const Conditions& conditions) {
    return conditions.interval_s() * static_cast<double>(conditions.size());
  }
  static Spectrum below(Spectrum spectrum, double highest_hz) {
    const auto bins = static_cast<std::size_t>(std::min(
        highest_hz / spectrum.resolution_hz + 1.0, static_cast<double>(spectrum.density.size())));
    spectrum.density.resize(bins);
    return spectrum;
  }
  static void keep(const Evidence& e, const effects::Sinusoidal& sine,
                   std::vector<effects::Sinusoidal>& in) {
    if (!follows_motion(e, sine) && !is_line_beside(e.conditions(), sine.frequency_hz))
      in.push_back(sine);
  }

  /// The sine of a frequency in the rate error, seen in samples or in the means of clusters.
  static effects::Sinusoidal sine_at(const Evidence& e, double frequency_hz, bool slow) {
    const auto& conditions = e.conditions();
    const double interval_s = slow ? conditions.slow_interval_s() : conditions.interval_s();
    const auto line =
        line_at(slow ? e.scene.slow_dps : e.scene.rate_error_dps,
                slow ? conditions.slow_spans(Part::train) : conditions.spans(Part::train),
                frequency_hz, interval_s);
    const double half = slow ? 0.5 * (conditions.slow_interval_s() - conditions.interval_s()) : 0.0;
    const double phase = (std::arg(line) + 0.5 * std::numbers::pi) * 180.0 / std::numbers::pi -
                         360.0 * frequency_hz * half;
    const double x = std::numbers::pi * frequency_hz * interval_s;
    const double lost = slow && x > 0.0 ? std::sin(x) / x : 1.0;
    return {std::abs(line) / lost, frequency_hz, wrap_degrees(phase)};
  }

  /// Values turned back by a frequency and summed up block by block, from which lines at
  /// frequencies near by are told.
  class NearLine {
   public:
    NearLine(const std::vector<double>& values, const std::vector<Span>& spans, double frequency_hz,
             double interval_s)
        : frequency_hz_(frequency_hz), interval_s_(interval_s) {
      const double angle = -2.0 * std::numbers::pi * frequency_hz * interval_s;
      const double c = std::cos(angle), s = std::sin(angle);
      for (const auto& span : spans) {
        double mean = 0.0;
        for (std::size_t i = span.first; i < span.last; ++i) mean += values[i];
        mean /= static_cast<double>(span.size());
        count_ += static_cast<double>(span.size());
        for (std::size_t first = span.first; first < span.last; first += block) {
          const std::size_t last = std::min(first + block, span.last);
          const double start = angle * static_cast<double>(first);
          double re = std::cos(start), im = std::sin(start), sum_re = 0.0, sum_im = 0.0;
          for (std::size_t i = first; i < last; ++i) {
            const double value = values[i] - mean;
            sum_re += value * re;
            sum_im += value * im;
            const double turned = re * c - im * s;
            im = re * s + im * c;
            re = turned;
          }
          blocks_.push_back({0.5 * static_cast<double>(first + last - 1), {sum_re, sum_im}});
        }
      }
    }

    /// Amplitude and phase, relative to the first value.
    std::complex<double> at(double frequency_hz) const {
      const double angle = -2.0 * std::numbers::pi * (frequency_hz - frequency_hz_) * interval_s_;
      std::complex<double> sum = 0.0;
      for (const auto& b : blocks_) sum += b.sum * std::polar(1.0, angle * b.middle);
      return 2.0 * sum / count_;
    }

    /// Of the frequencies from one to another, a step apart, where the line is largest; each block
    /// turns on from one of them to the next.
    double clearest_hz(double from_hz, double to_hz, double step_hz) const {
      std::vector<double> frequencies_hz;
      for (double f = std::max(from_hz, step_hz); f <= to_hz; f += step_hz)
        frequencies_hz.push_back(f);
      if (frequencies_hz.empty()) return frequency_hz_;
      std::vector<double> re(frequencies_hz.size(), 0.0), im = re;
      const double turn = -2.0 * std::numbers::pi * interval_s_;
      for (const auto& b : blocks_) {
        const auto by = std::polar(1.0, turn * step_hz * b.middle);
        auto at =
            b.sum * std::polar(1.0, turn * (frequencies_hz.front() - frequency_hz_) * b.middle);
        for (std::size_t k = 0; k < re.size(); ++k) {
          re[k] += at.real();
          im[k] += at.imag();
          at = {at.real() * by.real() - at.imag() * by.imag(),
                at.real() * by.imag() + at.imag() * by.real()};
        }
      }
      double best = frequency_hz_, largest = 0.0;
      for (std::size_t k = 0; k < re.size(); ++k)
        if (const double square = re[k] * re[k] + im[k] * im[k]; square > largest) {
          largest = square;
          best = frequencies_hz[k];
        }
      return best;
    }

   private:
    static constexpr std::size_t block = 32;  ///< short against a turn of any frequency near by
    struct Block {
      double middle;
      std::complex<double> sum;
    };
    double frequency_hz_, interval_s_, count_ = 0.0;
    std::vector<Block> blocks_;
  };

  static std::complex<double> line_at(const std::vector<double>& values,
                                      const std::vector<Span>& spans, double frequency_hz,
                                      double interval_s) {
    return NearLine(values, spans, frequency_hz, interval_s).at(frequency_hz);
  }

  /// Whether the line is the motion's own, scaled, rectified or delayed.
  static bool follows_motion(const Evidence& e, const effects::Sinusoidal& sine) {
    if (!e.conditions().has_motion()) return false;
    const auto motion = signatures(e, Trace::rate,
                                   {effects::ScaleFactor{1.0}, effects::ScaleAsymmetry{1.0},
                                    effects::SensorBandwidth{0.05 * e.conditions().rate_hz()}});
    return match(motion, signatures(e, Trace::rate, {sine}).col(0)).unexplained < 0.5;
  }
};

}  // namespace gyrostat::gap
