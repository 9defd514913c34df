#include <gyrostat/diagnosis/starts/line_beside.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace gyrostat::gap {
namespace {

constexpr double slowest_shaking_hz = 1.0;
constexpr double main_share = 0.5;  ///< of the variance
constexpr std::array beside = {&Series::rate_ref_dps,     &Series::cross_rate_1_dps,
                               &Series::cross_rate_2_dps, &Series::acc_x_mps2,
                               &Series::acc_y_mps2,       &Series::acc_z_mps2,
                               &Series::temperature_C};

/// Sums over the train part of a series less its first value.
struct Sums {
  double values = 0.0, squares = 0.0;
  std::complex<double> line = 0.0, tone = 0.0;

  void add(double value, std::complex<double> turn) {
    values += value;
    squares += value * value;
    line += value * turn;
    tone += turn;
  }
  /// Share of the variance that a sine has.
  double share(double count) const {
    const double mean = values / count, variance = squares / count - mean * mean;
    return variance > 0.0 ? 2.0 * std::norm((line - mean * tone) / count) / variance : 0.0;
  }
};

}  // namespace

bool is_line_beside(const Conditions& conditions, double frequency_hz) {
  if (frequency_hz >= slowest_shaking_hz) return false;
  const double angle = -2.0 * std::numbers::pi * frequency_hz * conditions.interval_s();
  const auto step = std::polar(1.0, angle);
  const auto is_line_of = [&](const std::vector<double>& values) {
    const auto first =
        std::find_if(values.begin(), values.end(), [](double value) { return !is_missing(value); });
    if (first == values.end()) return false;
    Sums plain, squared;
    double count = 0.0;
    for (const auto& span : conditions.spans(Part::train)) {
      auto turn = std::polar(1.0, angle * static_cast<double>(span.first));
      for (std::size_t i = span.first; i < span.last; ++i, turn *= step) {
        if (is_missing(values[i])) continue;
        plain.add(values[i] - *first, turn);
        squared.add(values[i] * values[i] - *first * *first, turn);
        ++count;
      }
    }
    return std::max(plain.share(count), squared.share(count)) > main_share;
  };
  const auto& series = conditions.series();
  return std::any_of(beside.begin(), beside.end(),
                     [&](const auto channel) { return is_line_of(series.*channel); });
}

}  // namespace gyrostat::gap
