#include <gyrostat/diagnosis/starts/line_beside.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

constexpr double slowest_shaking_hz = 1.0;
constexpr double main_share = 0.5;  ///< of the variance
constexpr std::array beside = {&Series::rate_ref_dps,     &Series::cross_rate_1_dps,
                               &Series::cross_rate_2_dps, &Series::acc_x_mps2,
                               &Series::acc_y_mps2,       &Series::acc_z_mps2,
                               &Series::temperature_C};

double mean_of(const std::vector<double>& values, const std::vector<Span>& spans) {
  double sum = 0.0, count = 0.0;
  for (const auto& span : spans)
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(values[i])) sum += values[i], ++count;
  return count > 0.0 ? sum / count : 0.0;
}

/// Of values whose own mean need not be 0.
struct Sums {
  double count = 0.0, values = 0.0, squares = 0.0;
  std::complex<double> line = 0.0, tone = 0.0;

  void add(double value, std::complex<double> turn) {
    ++count;
    values += value;
    squares += value * value;
    line += value * turn;
    tone += turn;
  }
  /// Share of the variance that a sine has.
  double share() const {
    const double mean = values / count, variance = squares / count - mean * mean;
    return variance > 0.0 ? 2.0 * std::norm((line - mean * tone) / count) / variance : 0.0;
  }
};

}  // namespace

bool is_line_beside(const Conditions& conditions, double frequency_hz) {
  if (frequency_hz >= slowest_shaking_hz) return false;
  const double angle = -2.0 * std::numbers::pi * frequency_hz * conditions.interval_s();
  const auto step = std::polar(1.0, angle);
  const auto& spans = conditions.spans(Part::train);
  const auto is_line_of = [&](const std::vector<double>& values) {
    if (values.empty()) return false;
    const double mean = mean_of(values, spans);
    Sums plain, squared;
    for (const auto& span : spans) {
      auto turn = std::polar(1.0, angle * static_cast<double>(span.first));
      for (std::size_t i = span.first; i < span.last; ++i, turn *= step) {
        if (is_missing(values[i])) continue;
        const double value = values[i] - mean;
        plain.add(value, turn);
        squared.add(value * value, turn);
      }
    }
    return plain.count > 0.0 && std::max(plain.share(), squared.share()) > main_share;
  };
  const auto& series = conditions.series();
  return std::any_of(beside.begin(), beside.end(),
                     [&](const auto channel) { return is_line_of(series.*channel); });
}

}  // namespace gyrostat::gap
