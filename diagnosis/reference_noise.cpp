#include <gyrostat/diagnosis/reference_noise.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

/// A motion of less than a tenth of the sampling rate leaves a thousandth of itself and less.
constexpr std::array<double, 7> sixth_difference = {1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0};
/// Of white noise of 1: its variance, and its autocorrelation at two lags.
constexpr double of_white = 924.0, white_lag_1 = -792.0 / 924.0, white_lag_3 = -220.0 / 924.0;

std::vector<double> sixth_differences(const std::vector<double>& values) {
  std::vector<double> d(values.size(), no_value);
  constexpr std::size_t reach = sixth_difference.size() / 2;
  for (std::size_t i = reach; i + reach < values.size(); ++i) {
    d[i] = 0.0;
    for (std::size_t j = 0; j < sixth_difference.size(); ++j)
      d[i] += sixth_difference[j] * values[i + j - reach];
  }
  return d;
}

struct Quiet {
  double square = 0.0;  ///< mean, of the reference's sixth differences
  double gyro_square = 0.0;
  double lag_1 = 0.0, lag_3 = 0.0;  ///< autocorrelation of the reference's
  double follows = 0.0;             ///< slope of the gyro's over the reference's
  double count = 0.0;
};

/// Of the blocks whose reference is quiet.
std::optional<Quiet> where_quiet(const Series& recording) {
  constexpr std::size_t block = 256, fewest = 8;
  const auto reference = sixth_differences(recording.rate_ref_dps);
  const auto gyro = sixth_differences(recording.gyro_dps);
  std::vector<double> squares;
  for (std::size_t first = 0; first + block <= reference.size(); first += block) {
    double sum = 0.0;
    for (std::size_t i = first; i < first + block; ++i) sum += reference[i] * reference[i];
    squares.push_back(sum / block);
  }
  std::vector<double> known;
  for (const double square : squares)
    if (!is_missing(square)) known.push_back(square);
  if (known.size() < fewest) return {};
  const double quiet = 1.5 * quantile(known, 0.25);

  Quiet q;
  double first = 0.0, third = 0.0, both = 0.0, of_both = 0.0;
  for (std::size_t b = 0; b < squares.size(); ++b) {
    if (!(squares[b] <= quiet)) continue;
    for (std::size_t i = b * block; i < (b + 1) * block; ++i) {
      q.count += 1.0;
      q.square += reference[i] * reference[i];
      if (i >= b * block + 3) {
        first += reference[i] * reference[i - 1];
        third += reference[i] * reference[i - 3];
      }
      if (is_missing(gyro[i])) continue;
      both += gyro[i] * reference[i];
      of_both += reference[i] * reference[i];
      q.gyro_square += gyro[i] * gyro[i];
    }
  }
  if (!(q.square > 0.0) || !(of_both > 0.0)) return {};
  constexpr double of_block = block / (block - 3.0);
  q.lag_1 = first / q.square * of_block;
  q.lag_3 = third / q.square * of_block;
  q.follows = both / of_both;
  q.gyro_square /= of_both / q.square * q.count;
  q.square /= q.count;
  return q;
}

double noise_of(const Quiet& quiet) {
  constexpr double off = 0.06;  // a motion is smooth, or a line
  if (std::abs(quiet.lag_1 - white_lag_1) > off || std::abs(quiet.lag_3 - white_lag_3) > off)
    return 0.0;
  // Whether the gyro has none of it or all of it, by its slope: differences of its noise are worth
  // a third as many independent ones.
  constexpr double worth = 0.316, likelier = 100.0;
  const double variance = quiet.gyro_square / quiet.square / (worth * std::max(quiet.count, 1.0));
  const bool is_noise = 0.5 - quiet.follows > std::log(likelier) * variance;
  return is_noise ? std::sqrt(quiet.square / of_white) : 0.0;
}

/// Weights of the centre of a parabola by least squares (Savitzky and Golay 1964), and the sum of
/// their squares.
struct Parabola {
  std::vector<double> weights;  ///< of the centre and of those so far from it on either side
  double variance;
};

Parabola parabola(std::size_t half) {
  const auto h = static_cast<double>(half);
  const double scale = 1.0 / ((2.0 * h - 1.0) * (2.0 * h + 1.0) * (2.0 * h + 3.0));
  Parabola p{{}, 3.0 * (3.0 * h * h + 3.0 * h - 1.0) * scale};
  for (std::size_t j = 0; j <= half; ++j) {
    const auto off = static_cast<double>(j);
    p.weights.push_back(3.0 * (3.0 * h * h + 3.0 * h - 1.0 - 5.0 * off * off) * scale);
  }
  return p;
}

/// A value that is there for what it is: equal to one beside it more often than noise has it.
bool has_values_of_its_own(const std::vector<double>& gyro) {
  constexpr double most = 1e-4;
  double equal = 0.0, count = 0.0;
  for (std::size_t i = 2; i < gyro.size(); ++i) {
    count += 1.0;
    if (gyro[i] == gyro[i - 1] || gyro[i] == gyro[i - 2]) equal += 1.0;
  }
  return equal > most * count;
}

}  // namespace

double reference_noise_dps(const Series& recording) {
  if (recording.rate_ref_dps.size() != recording.size()) return 0.0;
  const auto quiet = where_quiet(recording);
  return quiet ? noise_of(*quiet) : 0.0;
}

std::vector<double> without_white_noise(const std::vector<double>& values, double std) {
  constexpr std::array<std::size_t, 8> halves = {2, 3, 5, 8, 13, 21, 34, 55};
  constexpr double agree = 2.0;  // standard deviations
  std::vector<Parabola> parabolas;
  for (const std::size_t half : halves) parabolas.push_back(parabola(half));
  auto smooth = values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_missing(values[i])) continue;
    double low = values[i] - agree * std, high = values[i] + agree * std;
    for (std::size_t k = 0; k < halves.size(); ++k) {
      if (i < halves[k] || i + halves[k] >= values.size()) break;
      const auto& p = parabolas[k];
      double centre = p.weights[0] * values[i];
      for (std::size_t j = 1; j <= halves[k]; ++j)
        centre += p.weights[j] * (values[i - j] + values[i + j]);
      const double within = agree * std * std::sqrt(p.variance);
      low = std::max(low, centre - within);
      high = std::min(high, centre + within);
      if (!(low <= high)) break;
      smooth[i] = (centre - p.weights[0] * values[i]) / (1.0 - p.weights[0]);
    }
  }
  return smooth;
}

Series without_reference_noise(Series recording, std::vector<std::string>& told) {
  const double noise = reference_noise_dps(recording);
  if (noise == 0.0) return recording;
  auto smooth = without_white_noise(recording.rate_ref_dps, noise);
  if (!has_values_of_its_own(recording.gyro_dps))
    for (std::size_t i = 0; i < recording.size(); ++i)
      recording.gyro_dps[i] += smooth[i] - recording.rate_ref_dps[i];
  recording.rate_ref_dps = std::move(smooth);
  told.push_back(fmt::format(
      "the reference rate has white noise of {:.3g} dps, which the gyro does not follow: it is "
      "taken out",
      noise));
  return recording;
}

}  // namespace gyrostat::gap
