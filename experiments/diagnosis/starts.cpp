#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/gap/allan_components.hpp"
#include "experiments/diagnosis/candidate.hpp"
#include "experiments/diagnosis/model_fit.hpp"
#include "experiments/diagnosis/signature.hpp"

namespace gyrostat::gap {
namespace {

using namespace effects;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Steps from sample to sample of the train part.
std::vector<double> train_steps(const Evidence& e) {
  std::vector<double> steps;
  for (const auto& span : e.simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first + 1; i < span.last; ++i)
      steps.push_back(e.scene.rate_error_dps[i] - e.scene.rate_error_dps[i - 1]);
  return steps;
}

Rest with_white(const Evidence& e, double white_std_dps) {
  Rest rest{e.baseline.random_error, e.baseline.thermal_drift};
  rest.random_error.measurement_noise_std_dps = white_std_dps;
  return rest;
}

/// The effect beside the random error that the baseline has.
template <class E>
std::vector<Start> with_noise_of(const Evidence& e, const E& effect) {
  return {Start{effect, {e.baseline.random_error, e.baseline.thermal_drift}}};
}

/// A deterministic effect beside the random error of the recording without it.
template <class E>
std::vector<Start> cleaned(const Evidence& e, const E& effect) {
  return {Start{effect, rest_without(e, effect)}};
}

template <class E>
std::vector<Start> start(const E& effect, const Evidence& e) {
  return with_noise_of(e, effect);
}

std::vector<Start> start(Quantization, const Evidence& e) {
  std::vector<double> sorted;
  for (const auto& span : e.simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first; i < span.last && sorted.size() < 50000; ++i)
      sorted.push_back(e.recording.gyro_dps[i]);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> gaps;
  const double least = std::max(1.5 * e.simulator.resolution_dps(), 1e-12);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > least) gaps.push_back(sorted[i] - sorted[i - 1]);
  const double lsb = gaps.size() > 2 && gaps.size() < sorted.size() / 5
                         ? quantile(gaps, 0.2)
                         : e.white_std_dps;
  const double rest = e.white_std_dps * e.white_std_dps - lsb * lsb / 12.0;
  return {{Quantization{lsb}, with_white(e,
                                        std::sqrt(std::max(rest, 0.01 * lsb * lsb)))}};
}

std::vector<Start> start(Outliers, const Evidence& e) {
  const auto steps = train_steps(e);
  std::vector<double> sizes(steps.size());
  std::transform(steps.begin(), steps.end(), sizes.begin(), [](double d) { return std::abs(d); });
  const double deviation = quantile(sizes, 0.5) / 0.6744897501960817;
  const double white = deviation / std::numbers::sqrt2;
  std::vector<Start> found;
  for (const double limit : {4.5, 3.5}) {
    double count = 0.0, square = 0.0;
    for (const double size : sizes)
      if (size > limit * deviation) {
        count += 1.0;
        square += size * size;
      }
    const double mean = count > 0.0 ? square / count : 36.0 * deviation * deviation;
    const double std = std::sqrt(std::max(mean - 2.0 * white * white, white * white)) * 0.8;
    const double seen = std::erfc(limit * deviation / (std * std::numbers::sqrt2));
    found.push_back({Outliers{std::clamp(0.5 * count / static_cast<double>(sizes.size()) /
                                             std::max(seen, 0.05), 1e-6, 0.5), std},
                     with_white(e, white)});
  }
  return found;
}

/// Autocovariance at lags 0, 1 and 2 of unit white noise through equal poles.
std::array<double, 3> through_poles(double pole, int poles) {
  std::vector<double> response(static_cast<std::size_t>(8.0 * poles / (1.0 - pole)) + 8, 0.0);
  response[0] = 1.0;
  for (int k = 0; k < poles; ++k) {
    double state = 0.0;
    for (double& h : response) h = state = pole * state + (1.0 - pole) * h;
  }
  std::array<double, 3> covariance{};
  for (std::size_t lag = 0; lag < 3; ++lag)
    for (std::size_t i = lag; i < response.size(); ++i) covariance[lag] += response[i] * response[i - lag];
  return covariance;
}

/// From the variance and the first autocorrelation of the steps from sample to sample.
std::vector<Start> start(NoiseBandwidth, const Evidence& e) {
  const auto steps = train_steps(e);
  double square = 0.0, lagged = 0.0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    square += steps[i] * steps[i];
    lagged += steps[i] * steps[i - 1];
  }
  const double rate_hz = e.simulator.conditions().rate_hz();
  std::vector<Start> found;
  for (const int poles : {1, 2, 4}) {
    double low = 0.002, high = 0.99;
    for (int k = 0; k < 30; ++k) {
      const double pole = 0.5 * (low + high);
      const auto r = through_poles(pole, poles);
      ((2.0 * r[1] - r[0] - r[2]) / (2.0 * (r[0] - r[1])) < lagged / square ? low : high) = pole;
    }
    const auto r = through_poles(low, poles);
    found.push_back({NoiseBandwidth{-std::log(low) * rate_hz / (2.0 * std::numbers::pi), 1.0 * poles},
                     with_white(e, std::sqrt(square / static_cast<double>(steps.size()) /
                                             (2.0 * (r[0] - r[1]))))});
  }
  return found;
}

std::vector<Start> start(NoiseTemperature, const Evidence& e) {
  const auto& T = e.simulator.conditions().series().temperature_C;
  double sum = 0.0, mean_T = 0.0, count = 0.0, tt = 0.0, tv = 0.0;
  for (int pass = 0; pass < 2; ++pass)
    for (const auto& span : e.simulator.conditions().spans(Part::train))
      for (std::size_t i = span.first + 1; i < span.last; ++i) {
        const double v = 0.5 * std::pow(e.scene.rate_error_dps[i] - e.scene.rate_error_dps[i - 1], 2);
        if (pass == 0) {
          sum += v;
          mean_T += T[i];
          count += 1.0;
        } else {
          const double d = T[i] - mean_T / count;
          tt += d * d;
          tv += d * (v - sum / count);
        }
      }
  return {{NoiseTemperature{tt > 0.0 ? 0.5 * tv / tt / (sum / count) : 0.0, mean_T / count},
           with_white(e, std::sqrt(sum / count))}};
}

/// With a random walk beside the component and without.
std::array<AllanComponents, 2> slow_fits(const Evidence& e, SlowComponent component) {
  const auto& conditions = e.simulator.conditions();
  const auto fit = [&](bool walk) {
    return fit_allan_components(conditions, e.scene, component, walk);
  };
  return {fit(true), fit(false)};
}

template <class Make>
std::vector<Start> slow_starts(const Evidence& e, SlowComponent component, const Make& make) {
  std::vector<Start> found;
  for (const auto& fit : slow_fits(e, component))
    found.push_back({make(fit), {fit.random_error, e.baseline.thermal_drift}});
  return found;
}

std::vector<Start> start(BiasInstability, const Evidence& e) {
  return slow_starts(e, SlowComponent::flicker, [](const auto& fit) { return BiasInstability{fit.slow_std_dps}; });
}

std::vector<Start> start(GaussMarkov, const Evidence& e) {
  return slow_starts(e, SlowComponent::gauss_markov, [](const auto& fit) {
    return GaussMarkov{fit.slow_std_dps, fit.correlation_time_s};
  });
}

std::vector<Start> start(Telegraph, const Evidence& e) {
  return slow_starts(e, SlowComponent::gauss_markov, [](const auto& fit) {
    return Telegraph{fit.slow_std_dps, 2.0 * fit.correlation_time_s};
  });
}

/// A sudden change of the slow values.
struct Jump {
  std::size_t at;
  double size_dps;
};

/// Where the means of `reach` slow values before and after differ by more than six of their own
/// robust deviations, the largest of each neighbourhood; `clearness` is of the largest.
std::vector<Jump> jumps_over(const Evidence& e, std::size_t reach, double& clearness) {
  const auto& slow = e.scene.slow_dps;
  std::vector<Jump> differences;
  for (const auto& span : e.simulator.conditions().slow_spans(Part::train)) {
    if (span.size() < 2 * reach) continue;
    double before = 0.0, after = 0.0;
    for (std::size_t k = 0; k < reach; ++k) before += slow[span.first + k], after += slow[span.first + reach + k];
    for (std::size_t i = span.first + reach;; ++i) {
      differences.push_back({i, (after - before) / static_cast<double>(reach)});
      if (i + reach >= span.last) break;
      before += slow[i] - slow[i - reach];
      after += slow[i + reach] - slow[i];
    }
  }
  std::vector<double> sizes;
  for (const auto& d : differences) sizes.push_back(std::abs(d.size_dps));
  const double deviation = quantile(sizes, 0.5) / 0.6744897501960817;
  std::sort(differences.begin(), differences.end(),
            [](const Jump& a, const Jump& b) { return std::abs(a.size_dps) > std::abs(b.size_dps); });
  std::vector<Jump> found;
  for (const auto& d : differences) {
    if (std::abs(d.size_dps) < 6.0 * deviation || found.size() == 200) break;
    const auto near = [&](const Jump& other) { return std::max(d.at, other.at) - std::min(d.at, other.at) < 2 * reach; };
    if (std::none_of(found.begin(), found.end(), near)) found.push_back(d);
  }
  clearness = found.empty() ? 0.0 : std::abs(found.front().size_dps) / deviation;
  return found;
}

std::vector<Jump> jumps(const Evidence& e) {
  std::vector<Jump> best;
  double clearest = 0.0;
  for (const std::size_t reach : {4U, 8U, 16U, 32U, 64U}) {
    double clearness = 0.0;
    if (auto found = jumps_over(e, reach, clearness); clearness > clearest) {
      clearest = clearness;
      best = std::move(found);
    }
  }
  return best;
}

/// The jumps that are seen, beside what is left without them; and the random walk in steps.
std::vector<Start> start(BiasSteps, const Evidence& e) {
  std::vector<Start> found;
  if (const auto seen = jumps(e); !seen.empty()) {
    const auto& conditions = e.simulator.conditions();
    Series rest = e.recording;
    double square = 0.0;
    for (const auto& jump : seen) {
      square += jump.size_dps * jump.size_dps;
      for (std::size_t i = jump.at * conditions.cluster(); i < rest.size(); ++i) rest.gyro_dps[i] -= jump.size_dps;
    }
    rest.heading_deg.clear();
    const auto count = static_cast<double>(seen.size());
    found.push_back({BiasSteps{count / e.seconds_of_train() * 3600.0, std::sqrt(square / count)},
                     fit_rest(conditions, Scene(conditions, rest))});
  }
  auto arima = e.baseline.random_error;
  const double walk = (arima.delta1_dps - arima.delta2_dps) / (1.0 - arima.phi);
  const double an_hour = walk * walk * e.simulator.conditions().rate_hz() * 3600.0;
  arima.delta1_dps *= 0.1;
  arima.delta2_dps *= 0.1;
  for (const double steps : {3.0, 12.0, 50.0})
    found.push_back({BiasSteps{steps, std::sqrt(an_hour / steps)}, {arima, e.baseline.thermal_drift}});
  return found;
}

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
    for (std::size_t k = 3 + reach; k + reach < s.size(); k += std::max<std::size_t>(1, reach / 2)) {
      const std::size_t low = k > 6 * reach ? k - 6 * reach : 1;
      const std::size_t high = std::min(s.size(), k + 6 * reach + 1);
      std::vector<double> around;
      double inside = 0.0;
      for (std::size_t j = low; j < high; ++j)
        if (j + reach < k || j > k + reach) around.push_back(s[j]);
        else inside += s[j];
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
    for (std::size_t i = span.first; i < span.last; ++i, turn *= step) sum += (values[i] - mean) * turn;
    count += static_cast<double>(span.size());
  }
  return 2.0 * sum / count;
}

/// Whether the line is the motion's own, scaled, rectified or delayed.
bool follows_motion(const Evidence& e, const Sinusoidal& sine) {
  if (!e.simulator.conditions().has_motion()) return false;
  const auto motion = signatures(e, Trace::rate, {ScaleFactor{1.0}, ScaleAsymmetry{1.0},
                                                  SensorBandwidth{0.05 * e.simulator.conditions().rate_hz()}});
  return match(motion, signatures(e, Trace::rate, {sine}).col(0)).unexplained < 0.5;
}

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
    const double phase = (std::arg(line) + 0.5 * std::numbers::pi) * 180.0 / std::numbers::pi -
                         360.0 * best * half;
    const double x = std::numbers::pi * best * interval_s;
    const double lost = slow && x > 0.0 ? std::sin(x) / x : 1.0;
    const Sinusoidal sine{std::abs(line) / lost, best, wrap_degrees(phase)};
    if (follows_motion(e, sine)) continue;
    found.push_back({sine, rest_without(e, sine)});
  }
  return found;
}

/// The resonance of the same peak and power about the peak: a Lorentzian's power is pi / 2 times its
/// height times its width.
Vibration resonance(const Spectrum& spectrum, const Peak& peak) {
  const auto& s = spectrum.density;
  const auto low = static_cast<std::size_t>(std::max(1.0, (peak.frequency_hz - peak.width_hz) / spectrum.resolution_hz));
  const auto high = std::min(s.size() - 1, static_cast<std::size_t>((peak.frequency_hz + peak.width_hz) / spectrum.resolution_hz));
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

std::vector<Start> start(Vibration, const Evidence& e) {
  std::vector<Start> found;
  const auto peak = highest_peak(e.scene.spectra[0]);
  const double white = e.baseline.random_error.measurement_noise_std_dps;
  if (peak.frequency_hz <= 0.0 || peak.power <= 0.0) return with_noise_of(e, Vibration{0.5 * white, 5.0, 1.0});
  std::vector<Vibration> shapes = {resonance(e.scene.spectra[0], peak)};
  for (const double width : {0.4, 1.0})
    shapes.push_back({std::sqrt(1.3 * peak.power), peak.frequency_hz, width * peak.width_hz});
  for (const auto& shape : shapes) {
    const double rest = white * white - shape.std_dps * shape.std_dps;
    found.push_back({shape, with_white(e, std::sqrt(std::max(0.1 * white * white, rest)))});
  }
  return found;
}

std::vector<Start> start(StaleSamples, const Evidence& e) {
  double count = 0.0, pairs = 0.0, triples = 0.0;
  const auto& z = e.recording.gyro_dps;
  for (const auto& span : e.simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first + 2; i < span.last; ++i) {
      count += 1.0;
      if (z[i] != z[i - 1]) continue;
      pairs += 1.0;
      if (z[i] == z[i - 2]) triples += 1.0;
    }
  const double run = pairs > 0.0 ? 1.0 / std::max(0.02, 1.0 - triples / pairs) : 1.0;
  return with_noise_of(e, StaleSamples{std::clamp(pairs / run / count, 1e-6, 1.0), run});
}

/// An effect whose size is linear: its best amplitude, given everything else.
template <class E, class Set>
E scaled(const Evidence& e, Trace trace, E effect, const Set& set) {
  set(effect, 1.0);
  set(effect, match(signatures(e, trace, {effect}), trace_of(e, trace)).amplitudes[0]);
  return effect;
}

std::vector<Start> start(RateRamp, const Evidence& e) {
  return cleaned(e, scaled(e, Trace::slow_rate, RateRamp{},
                                 [](auto& p, double a) { p.slope_dps_per_s = a; }));
}

std::vector<Start> start(ThermalCurvature, const Evidence& e) {
  const auto& T = e.simulator.conditions().slow_temperature_C();
  const double middle = 0.5 * (*std::min_element(T.begin(), T.end()) + *std::max_element(T.begin(), T.end()));
  return cleaned(e, scaled(e, Trace::slow_rate, ThermalCurvature{1.0, middle},
                                 [](auto& p, double a) { p.curvature_dps_per_C2 = a; }));
}

/// Amplitude and one nonlinear parameter together.
template <class E, class Set>
E scaled_over(const Evidence& e, Trace trace, E effect, double E::*shape, double low, double high,
              const Set& set) {
  const auto seen = trace_of(e, trace);
  set(effect, 1.0);
  effect.*shape = best_of(low, high, [&](double value) {
    E trial = effect;
    trial.*shape = value;
    return match(signatures(e, trace, {trial}), seen).unexplained;
  });
  set(effect, match(signatures(e, trace, {effect}), seen).amplitudes[0]);
  return effect;
}

std::vector<Start> start(ThermalHysteresis, const Evidence& e) {
  const auto& T = e.simulator.conditions().slow_temperature_C();
  const double span = *std::max_element(T.begin(), T.end()) - *std::min_element(T.begin(), T.end());
  return cleaned(e, scaled_over(e, Trace::slow_rate, ThermalHysteresis{}, &ThermalHysteresis::width_C,
                                      0.02 * span, 0.45 * span,
                                      [](auto& p, double a) { p.amplitude_dps = a; }));
}

std::vector<Start> start(ThermalLag, const Evidence& e) {
  const auto& c = e.simulator.conditions();
  return cleaned(e, scaled_over(e, Trace::slow_rate, ThermalLag{}, &ThermalLag::time_constant_s,
                                      2.0 * c.slow_interval_s(),
                                      0.5 * c.slow_interval_s() * static_cast<double>(c.slow_size()),
                                      [](auto& p, double a) { p.sensitivity_dps_per_C = a; }));
}

std::vector<Start> start(ScaleFactor, const Evidence& e) {
  return cleaned(e, scaled(e, Trace::rate, ScaleFactor{}, [](auto& p, double a) { p.error = a; }));
}

std::vector<Start> start(ScaleAsymmetry, const Evidence& e) {
  return cleaned(e, scaled(e, Trace::rate, ScaleAsymmetry{}, [](auto& p, double a) { p.error = a; }));
}

/// An effect of fixed size with one parameter.
template <class E>
E shaped(const Evidence& e, Trace trace, E effect, double E::*shape, double low, double high) {
  const auto seen = trace_of(e, trace);
  effect.*shape = best_of(low, high, [&](double value) {
    E trial = effect;
    trial.*shape = value;
    return (seen - signatures(e, trace, {trial})).squaredNorm();
  });
  return effect;
}

double fastest(const Evidence& e) {
  double fastest = 0.0;
  for (const double rate : e.simulator.conditions().series().rate_ref_dps)
    fastest = std::max(fastest, std::abs(rate));
  return fastest;
}

std::vector<Start> start(SensorBandwidth, const Evidence& e) {
  const double rate_hz = e.simulator.conditions().rate_hz();
  return cleaned(e, shaped(e, Trace::rate, SensorBandwidth{}, &SensorBandwidth::cutoff_hz,
                                 0.002 * rate_hz, 0.5 * rate_hz));
}

std::vector<Start> start(DeadZone, const Evidence& e) {
  std::vector<Start> found;
  for (const double lost : {0.0, 1.0}) {
    const auto effect = shaped(e, Trace::rate, DeadZone{.lost_beyond = lost}, &DeadZone::half_width_dps,
                               0.001 * fastest(e), 0.5 * fastest(e));
    found.push_back({effect, rest_without(e, effect)});
  }
  return found;
}

std::vector<Start> start(Saturation, const Evidence& e) {
  return cleaned(e, shaped(e, Trace::rate, Saturation{}, &Saturation::limit_dps,
                                 0.05 * fastest(e), 1.02 * fastest(e)));
}

std::vector<Start> start(GSensitivity, const Evidence& e) {
  const auto columns = signatures(e, Trace::slow_rate,
                                  {GSensitivity{1.0, 0.0, 0.0}, GSensitivity{0.0, 1.0, 0.0},
                                   GSensitivity{0.0, 0.0, 1.0}});
  const auto found = match(columns, trace_of(e, Trace::slow_rate)).amplitudes;
  return cleaned(e, GSensitivity{found[0], found[1], found[2]});
}

template <class Iron>
Iron iron(const Evidence& e) {
  const auto columns = signatures(e, Trace::heading, {Iron{0.1, 0.0}, Iron{0.1, 90.0}});
  const Eigen::VectorXd found = 0.1 * match(columns, trace_of(e, Trace::heading)).amplitudes;
  return {std::hypot(found[0], found[1]), std::atan2(found[1], found[0]) * 180.0 / std::numbers::pi};
}

std::vector<Start> start(HardIron, const Evidence& e) { return with_noise_of(e, iron<HardIron>(e)); }
std::vector<Start> start(SoftIron, const Evidence& e) { return with_noise_of(e, iron<SoftIron>(e)); }

std::vector<Start> start(CompassLag, const Evidence& e) {
  return cleaned(e, shaped(e, Trace::heading, CompassLag{}, &CompassLag::time_constant_s,
                                 0.5 * e.simulator.conditions().interval_s(), 30.0));
}

std::vector<Start> start(MagneticBursts, const Evidence& e) {
  std::vector<double> sizes;
  const auto& slow = e.scene.slow_heading_deg;
  const auto& conditions = e.simulator.conditions();
  for (const auto& span : conditions.slow_spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(slow[i])) sizes.push_back(slow[i]);
  const double centre = quantile(sizes, 0.5);
  for (double& size : sizes) size = std::abs(size - centre);
  const double limit = 6.0 * quantile(sizes, 0.5) / 0.6744897501960817;
  double hit = 0.0, bursts = 0.0, square = 0.0;
  bool inside = false;
  for (const double size : sizes) {
    if (size > limit) {
      hit += 1.0;
      bursts += inside ? 0.0 : 1.0;
      square += size * size;
    }
    inside = size > limit;
  }
  const double interval_s = conditions.slow_interval_s();
  const double hours = static_cast<double>(sizes.size()) * interval_s / 3600.0;
  if (hit == 0.0) return with_noise_of(e, MagneticBursts{5.0 / std::max(hours, 0.1), 20.0, 2.0 * limit});
  return with_noise_of(e, MagneticBursts{bursts / hours, std::max(hit * interval_s / bursts, interval_s),
                                         std::sqrt(square / hit)});
}

template <class E>
constexpr bool is_slow_signature =
    std::is_same_v<E, RateRamp> || std::is_same_v<E, ThermalCurvature> ||
    std::is_same_v<E, ThermalHysteresis> || std::is_same_v<E, ThermalLag> ||
    std::is_same_v<E, GSensitivity>;

template <class E>
constexpr bool deterministic = is_slow_signature<E> ||
    std::is_same_v<E, Sinusoidal> || std::is_same_v<E, ScaleFactor> || std::is_same_v<E, ScaleAsymmetry> ||
    std::is_same_v<E, SensorBandwidth> || std::is_same_v<E, Saturation> ||
    std::is_same_v<E, DeadZone> || std::is_same_v<E, HardIron> ||
    std::is_same_v<E, SoftIron> || std::is_same_v<E, CompassLag>;

}  // namespace

double Evidence::seconds_of_train() const {
  double samples = 0.0;
  for (const auto& span : simulator.conditions().spans(Part::train))
    samples += static_cast<double>(span.size());
  return samples * simulator.conditions().interval_s();
}

std::vector<Start> starts(const Effects::Any& effect, const Evidence& evidence) {
  return std::visit([&](const auto& any) {
    if (!is_slow_signature<std::decay_t<decltype(any)>>) return start(any, evidence);
    // The effect itself inflated the random walk of the baseline: first as if there were none, then
    // with what is left without the effect.
    Evidence cleaner = evidence;
    cleaner.baseline.random_error.delta1_dps = cleaner.baseline.random_error.delta2_dps = 0.0;
    for (int pass = 0; pass < 2; ++pass)
      cleaner.baseline.random_error = start(any, cleaner).front().rest.random_error;
    auto found = start(any, cleaner);
    cleaner.baseline.random_error = found.front().rest.random_error;
    const auto seen = trace_of(cleaner, Trace::slow_rate);
    const double unexplained =
        match(signatures(cleaner, Trace::slow_rate, {found.front().effect}), seen).unexplained;
    found.front().most_gain =
        0.5 * static_cast<double>(seen.size()) * (1.0 / std::max(unexplained, 1e-12) - 1.0);
    return found;
  }, effect);
}

bool is_what_it_is_called(const Effects::Any& effect, const Conditions& conditions) {
  const double shortest_s = 5.0 * conditions.interval_s();
  const double longest_s = conditions.interval_s() * static_cast<double>(conditions.size());
  if (const auto* v = std::get_if<Vibration>(&effect))
    return v->bandwidth_hz < 0.5 * v->centre_hz && v->bandwidth_hz > 0.02 * v->centre_hz;
  if (const auto* g = std::get_if<GaussMarkov>(&effect)) return g->correlation_time_s > shortest_s;
  if (const auto* t = std::get_if<Telegraph>(&effect))  // it is seen to come back to its levels
    return t->mean_dwell_s > shortest_s && t->mean_dwell_s < longest_s / 6.0;
  if (const auto* b = std::get_if<MagneticBursts>(&effect)) return b->std_deg < 90.0;
  return true;
}

bool is_deterministic(const Effects::Any& effect) {
  return std::visit([]<class E>(const E&) { return deterministic<E>; }, effect);
}

std::vector<std::string_view> free_parameters(const Effects::Any& effect) {
  std::vector<std::string_view> names;
  std::visit([&](const auto& any) {
    for (const auto& field : any.fields())
      if (field.name != "reference_C" && field.name != "lsb_dps" && field.name != "poles")
        names.push_back(field.name);
  }, effect);
  return names;
}

}  // namespace gyrostat::gap
