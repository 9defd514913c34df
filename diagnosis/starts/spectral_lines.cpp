#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/diagnosis/starts/start.hpp>

namespace gyrostat::gap {

using namespace effects;

namespace {

/// The frequency with the largest peak over its surroundings, and the power above them.
struct Peak {
  double frequency_hz = 0.0, power = 0.0, width_hz = 0.0, excess = 0.0;
  double floor = 0.0;  ///< density of the surroundings
};

Peak highest_peak(const Spectrum& spectrum) {
  Peak best;
  const auto& s = spectrum.density;
  if (s.size() < 24) return best;
  for (std::size_t reach : {std::size_t{1}, std::size_t{4}, std::size_t{16}, std::size_t{64}}) {
    for (std::size_t k = 3 + reach; k + reach < s.size();
         k += std::max<std::size_t>(1, reach / 2)) {
      const std::size_t low = k > 6 * reach ? k - 6 * reach : 1;
      const std::size_t high = std::min(s.size(), k + 6 * reach + 1);
      std::vector<double> around;
      double inside = 0.0;
      for (std::size_t j = low; j < high; ++j)
        if (j + reach < k || j > k + reach)
          around.push_back(s[j]);
        else
          inside += s[j];
      const double floor = quantile(around, 0.5);
      const double bins = static_cast<double>(2 * reach + 1);
      const double excess = inside - floor * bins;
      const double significance = excess / (floor * std::sqrt(bins));
      if (significance <= best.excess) continue;
      double centre = 0.0, weight = 0.0;
      for (std::size_t j = k - reach; j <= k + reach; ++j) {
        const double above = std::max(0.0, s[j] - floor);
        centre += above * static_cast<double>(j);
        weight += above;
      }
      best = {spectrum.resolution_hz * (weight > 0.0 ? centre / weight : static_cast<double>(k)),
              excess * spectrum.resolution_hz, spectrum.resolution_hz * bins, significance, floor};
    }
  }
  return best;
}

/// Power and phase of `values` at a frequency over the given stretches.
std::complex<double> line_at(const std::vector<double>& values, const std::vector<Span>& spans,
                             double frequency_hz, double interval_s) {
  const double angle = -2.0 * std::numbers::pi * frequency_hz * interval_s;
  std::complex<double> sum = 0.0;
  double count = 0.0;
  for (const auto& span : spans) {
    double mean = 0.0;
    for (std::size_t i = span.first; i < span.last; ++i) mean += values[i];
    mean /= static_cast<double>(span.size());
    std::complex<double> turn = std::polar(1.0, angle * static_cast<double>(span.first));
    const auto step = std::polar(1.0, angle);
    for (std::size_t i = span.first; i < span.last; ++i, turn *= step)
      sum += (values[i] - mean) * turn;
    count += static_cast<double>(span.size());
  }
  return 2.0 * sum / count;
}

/// Whether the line is the motion's own, scaled, rectified or delayed.
bool follows_motion(const Evidence& e, const Sinusoidal& sine) {
  if (!e.simulator.conditions().has_motion()) return false;
  const auto motion = signatures(e, Trace::rate,
                                 {ScaleFactor{1.0}, ScaleAsymmetry{1.0},
                                  SensorBandwidth{0.05 * e.simulator.conditions().rate_hz()}});
  return match(motion, signatures(e, Trace::rate, {sine}).col(0)).unexplained < 0.5;
}

/// The resonance of the same peak and power about the peak: a Lorentzian's power is pi / 2 times
/// its height times its width.
Vibration resonance(const Spectrum& spectrum, const Peak& peak) {
  const auto& s = spectrum.density;
  const auto low = static_cast<std::size_t>(
      std::max(1.0, (peak.frequency_hz - peak.width_hz) / spectrum.resolution_hz));
  const auto high = std::min(
      s.size() - 1,
      static_cast<std::size_t>((peak.frequency_hz + peak.width_hz) / spectrum.resolution_hz));
  std::size_t top = low;
  double height = 0.0, power = 0.0;
  for (std::size_t k = low; k < high; ++k) {
    const double around = (s[k - 1] + s[k] + s[k + 1]) / 3.0 - peak.floor;
    power += std::max(0.0, s[k] - peak.floor) * spectrum.resolution_hz;
    if (around > height) height = around, top = k;
  }
  if (height <= 0.0) return {std::sqrt(peak.power), peak.frequency_hz, peak.width_hz};
  return {std::sqrt(power), static_cast<double>(top) * spectrum.resolution_hz,
          2.0 * power / (std::numbers::pi * height)};
}

}  // namespace

std::vector<Start> start(Sinusoidal, const Evidence& e) {
  const auto& conditions = e.simulator.conditions();
  std::vector<Start> found;
  for (const bool slow : {false, true}) {
    const auto peak = highest_peak(slow ? e.scene.slow_spectra[0] : e.scene.spectra[0]);
    if (peak.frequency_hz <= 0.0) continue;
    const auto& values = slow ? e.scene.slow_dps : e.scene.rate_error_dps;
    const auto& spans = slow ? conditions.slow_spans(Part::train) : conditions.spans(Part::train);
    const double interval_s = slow ? conditions.slow_interval_s() : conditions.interval_s();
    const double duration_s = interval_s * static_cast<double>(values.size());
    const double resolution =
        slow ? e.scene.slow_spectra[0].resolution_hz : e.scene.spectra[0].resolution_hz;
    double best = peak.frequency_hz, largest = 0.0;
    double reach = 1.5 * resolution, step = std::max(0.3 / duration_s, resolution / 400.0);
    for (int pass = 0; pass < 2; ++pass) {
      const double centre = best;
      for (double f = std::max(centre - reach, step); f <= centre + reach; f += step)
        if (const double a = std::abs(line_at(values, spans, f, interval_s)); a > largest) {
          largest = a;
          best = f;
        }
      reach = step;
      step /= 8.0;
    }
    const auto line = line_at(values, spans, best, interval_s);
    const double half = slow ? 0.5 * (conditions.slow_interval_s() - conditions.interval_s()) : 0.0;
    const double phase =
        (std::arg(line) + 0.5 * std::numbers::pi) * 180.0 / std::numbers::pi - 360.0 * best * half;
    const double x = std::numbers::pi * best * interval_s;
    const double lost = slow && x > 0.0 ? std::sin(x) / x : 1.0;
    const Sinusoidal sine{std::abs(line) / lost, best, wrap_degrees(phase)};
    if (follows_motion(e, sine)) continue;
    found.push_back({sine, rest_without(e, sine)});
  }
  return found;
}

std::vector<Start> start(Vibration, const Evidence& e) {
  std::vector<Start> found;
  const auto peak = highest_peak(e.scene.spectra[0]);
  const double white = e.baseline.random_error.measurement_noise_std_dps;
  if (peak.frequency_hz <= 0.0 || peak.power <= 0.0)
    return with_noise_of(e, Vibration{0.5 * white, 5.0, 1.0});
  std::vector<Vibration> shapes = {resonance(e.scene.spectra[0], peak)};
  for (const double width : {0.4, 1.0})
    shapes.push_back({std::sqrt(1.3 * peak.power), peak.frequency_hz, width * peak.width_hz});
  for (const auto& shape : shapes) {
    const double rest = white * white - shape.std_dps * shape.std_dps;
    found.push_back({shape, with_white(e, std::sqrt(std::max(0.1 * white * white, rest)))});
  }
  return found;
}

}  // namespace gyrostat::gap
