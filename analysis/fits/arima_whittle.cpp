#include <gyrostat/analysis/fits/arima_whittle.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include <gyrostat/analysis/spectra/welch.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t shortest_segment = 1024;
constexpr std::size_t times_shorter = 16;  ///< are segments from one octave of lengths to the next
constexpr std::size_t lowest_of_all = 4, lowest = 8;  ///< bins of a segment that are used

std::vector<std::span<const double>> stretches_of(std::span<const double> z) {
  std::vector<std::span<const double>> stretches;
  for (std::size_t from = 0; from < z.size();) {
    const auto first = std::find_if(z.begin() + static_cast<std::ptrdiff_t>(from), z.end(),
                                    [](double v) { return !is_missing(v); });
    const auto last = std::find_if(first, z.end(), [](double v) { return is_missing(v); });
    if (first != last) stretches.emplace_back(first, last);
    from = static_cast<std::size_t>(last - z.begin());
  }
  return stretches;
}

}  // namespace

ArimaWhittle::ArimaWhittle(std::span<const double> rate_dps) {
  const auto stretches = stretches_of(rate_dps);
  std::size_t longest = 0, samples = 0;
  for (const auto& stretch : stretches) {
    longest = std::max(longest, stretch.size());
    samples += stretch.size();
  }
  if (longest < shortest) return;
  for (std::size_t length = std::bit_floor(longest), from = lowest_of_all;;
       length /= times_shorter, from = lowest) {
    const bool is_last = length / times_shorter < shortest_segment;
    const std::size_t to = is_last ? length / 2 : lowest * times_shorter;
    add_terms(welch(stretches, 1.0, length, length / 4).density, length, from, to,
              static_cast<double>(samples));
    if (is_last) break;
  }
}

void ArimaWhittle::add_terms(const std::vector<double>& density, std::size_t length,
                             std::size_t from, std::size_t to, double samples) {
  const double bins = static_cast<double>(length);
  for (std::size_t k = from; k < to;) {
    const std::size_t count = std::min(std::max<std::size_t>(1, k / 16), to - k);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += 0.5 * density[k + i];
    const double middle = static_cast<double>(k) + 0.5 * static_cast<double>(count - 1);
    terms_.push_back({.cosine = std::cos(2.0 * std::numbers::pi * middle / bins),
                      .density = sum / static_cast<double>(count),
                      .weight = static_cast<double>(count) * samples / bins});
    k += count;
  }
}

ArimaMisfit ArimaWhittle::about(const Arima111<double>& arima) const {
  const auto& [phi, delta1, delta2, noise] = arima;
  ArimaMisfit misfit;
  for (const auto& [cosine, shown, weight] : terms_) {
    const double remembered = 1.0 + phi * phi - 2.0 * phi * cosine;
    const double per_drive = 1.0 / (remembered * 2.0 * (1.0 - cosine));
    const double walk =
        (delta1 * delta1 + delta2 * delta2 - 2.0 * delta1 * delta2 * cosine) * per_drive;
    const double density = walk + noise * noise;
    const Eigen::Vector4d relative =
        Eigen::Vector4d(-walk * 2.0 * (phi - cosine) / remembered,
                        2.0 * (delta1 - delta2 * cosine) * per_drive,
                        2.0 * (delta2 - delta1 * cosine) * per_drive, 2.0 * noise) /
        density;
    const double ratio = shown / density;
    misfit.value += weight * (std::log(density) + ratio);
    misfit.gradient += weight * (1.0 - ratio) * relative;
    misfit.information.noalias() += weight * relative * relative.transpose();
  }
  return misfit;
}

std::vector<ArimaMisfit> ArimaWhittle::operator()(std::span<const Arima111<double>> models) const {
  std::vector<ArimaMisfit> misfits;
  for (const auto& one : models) misfits.push_back(about(one));
  return misfits;
}

}  // namespace gyrostat
