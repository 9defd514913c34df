#include <gyrostat/diagnosis/known_motion.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <unsupported/Eigen/FFT>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

using Values = std::vector<double>;

/// About their mean, 0 where missing and beyond the end.
Values centred(std::span<const double> values, std::size_t size) {
  double sum = 0.0, count = 0.0;
  for (const double v : values)
    if (!is_missing(v)) sum += v, count += 1.0;
  Values about(size, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!is_missing(values[i])) about[i] = values[i] - sum / std::max(count, 1.0);
  return about;
}

/// The lag of the largest correlation: of the first samples, which are enough.
std::ptrdiff_t whole_lag(const Series& recording, std::ptrdiff_t most) {
  constexpr std::size_t enough = 1 << 20;
  const std::size_t looked_at = std::min(recording.size(), enough);
  const std::size_t size = std::bit_ceil(looked_at + static_cast<std::size_t>(most) + 1);
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> gyro, rate;
  fft.fwd(gyro, centred(std::span(recording.gyro_dps).first(looked_at), size));
  fft.fwd(rate, centred(std::span(recording.rate_ref_dps).first(looked_at), size));
  for (std::size_t k = 0; k < gyro.size(); ++k) gyro[k] *= std::conj(rate[k]);
  Values products;
  fft.inv(products, gyro);
  std::ptrdiff_t best = 0;
  const auto at = [&](std::ptrdiff_t lag) {
    return products[static_cast<std::size_t>(lag < 0 ? lag + static_cast<std::ptrdiff_t>(size)
                                                     : lag)];
  };
  for (std::ptrdiff_t lag = -most; lag <= most; ++lag)
    if (at(lag) > at(best)) best = lag;
  return best;
}

/// The gyro as a level and a scale of the rate `lag` samples ago, and of its slope.
struct Shifted {
  double later = 0.0;  ///< samples beyond the lag
  double left_dps = 0.0;
  double scale = 0.0;
  double share_left = 1.0;  ///< of the gyro's variance
};
std::optional<Shifted> shifted(const Series& recording, std::ptrdiff_t lag) {
  const auto n = static_cast<std::ptrdiff_t>(recording.size());
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d with = Eigen::Vector3d::Zero();
  double squares = 0.0, count = 0.0;  // of the gyro
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, lag + 1); i < std::min(n, n + lag - 1); ++i) {
    const auto rate = [&](std::ptrdiff_t k) {
      return recording.rate_ref_dps[static_cast<std::size_t>(i - lag + k)];
    };
    const double seen = recording.gyro_dps[static_cast<std::size_t>(i)];
    const Eigen::Vector3d row(1.0, rate(0), 0.5 * (rate(1) - rate(-1)));
    if (is_missing(seen) || !row.allFinite()) continue;
    normal += row * row.transpose();
    with += row * seen;
    squares += seen * seen;
    count += 1.0;
  }
  constexpr double fewest = 100.0;
  if (count < fewest) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> solved(normal);
  const Eigen::Vector3d sizes = solved.solve(with);
  if (!sizes.allFinite() || sizes[1] == 0.0) return std::nullopt;
  const double left = std::max(0.0, (squares - sizes.dot(with)) / count);
  const double variance = squares / count - with[0] * with[0] / (count * count);
  return Shifted{-sizes[2] / sizes[1], std::sqrt(left), sizes[1], left / variance};
}

struct Lateness {
  double samples = 0.0, left_dps = 0.0;
};
Lateness lateness_of(const Series& recording) {
  constexpr std::size_t shortest = 500, share = 20, farthest = 50'000;
  constexpr double least_scale = 0.5, most_scale = 2.0, most_left = 0.1;
  constexpr int rounds = 5;
  if (recording.rate_ref_dps.size() < shortest) return {};
  const auto most = static_cast<std::ptrdiff_t>(std::min(recording.size() / share, farthest));
  auto lag = whole_lag(recording, most);
  std::optional<Shifted> best;
  for (int round = 0; round < rounds; ++round) {
    best = shifted(recording, lag);
    if (!best || best->scale < least_scale || best->scale > most_scale ||
        best->share_left > most_left)
      return {};
    const auto next = lag + static_cast<std::ptrdiff_t>(std::lround(best->later));
    if (next == lag || std::abs(next) > most) break;
    lag = next;
  }
  return {static_cast<double>(lag) + std::clamp(best->later, -1.0, 1.0), best->left_dps};
}

}  // namespace

double lateness_samples(const Series& recording) { return lateness_of(recording).samples; }

Series with_known_motion(Series recording, std::vector<std::string>& told) {
  const auto [late, noise_dps] = lateness_of(recording);
  // A sample more, for filters besides.
  const auto count = static_cast<std::ptrdiff_t>(std::ceil(std::abs(late))) + 1;
  const auto n = static_cast<std::ptrdiff_t>(recording.size());
  const auto& rate = recording.rate_ref_dps;
  if (late == 0.0 || count >= n) return recording;
  const auto moved = [&](auto first) {
    double most = 0.0;
    for (std::ptrdiff_t i = 0; i <= count; ++i) most = std::max(most, std::abs(first[i] - *first));
    return most * std::min(1.0, std::abs(late)) > 3.0 * noise_dps;
  };
  const bool is_at_the_end = late < 0.0;
  if (!(is_at_the_end ? moved(rate.rbegin()) : moved(rate.begin()))) return recording;
  auto& gyro = recording.gyro_dps;
  if (is_at_the_end)
    std::fill(gyro.end() - count, gyro.end(), no_value);
  else
    std::fill(gyro.begin(), gyro.begin() + count, no_value);
  told.push_back(fmt::format(
      "the gyro is {:.3g} samples {} than the reference, which {} in motion: {} {} samples are "
      "left "
      "out",
      std::abs(late), is_at_the_end ? "earlier" : "later", is_at_the_end ? "ends" : "begins",
      is_at_the_end ? "the last" : "the first", count));
  return recording;
}

}  // namespace gyrostat::gap
