#include <gyrostat/diagnosis/remainder/filter.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <gyrostat/diagnosis/likelihood/changed_band.hpp>
#include <gyrostat/generators/effects/empirical_filter.hpp>
#include <gyrostat/generators/fast_part.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t coefficients = effects::EmpiricalFilter::order + 1;
using Cepstrum = std::array<double, coefficients>;

/// Of half of a logarithm of densities: that of the amplitude. Below `first` it is taken as 0.
Cepstrum cepstrum_of(const std::vector<double>& log_density, const std::vector<double>& mean,
                     std::size_t first) {
  Cepstrum c{};
  const std::size_t last = log_density.size() - 1;
  for (std::size_t bin = first; bin <= last; ++bin) {
    const double off = 0.5 * (log_density[bin] - mean[bin]) * (bin == last ? 0.5 : 1.0);
    const double angle = std::numbers::pi * static_cast<double>(bin) / static_cast<double>(last);
    for (std::size_t k = 0; k < coefficients; ++k)
      c[k] += (k == 0 ? 1.0 : 2.0) / static_cast<double>(last) * off *
              std::cos(angle * static_cast<double>(k));
  }
  return c;
}

std::string in_words(const Cepstrum& cepstrum, std::size_t order, const std::vector<double>& mean,
                     std::size_t first, double bin_hz) {
  const std::size_t last = mean.size() - 1;
  std::vector<double> change(mean.size(), 0.0);
  for (std::size_t bin = first; bin <= last; ++bin) {
    double log_gain = cepstrum[0];
    for (std::size_t k = 1; k <= order; ++k)
      log_gain += cepstrum[k] * std::cos(std::numbers::pi * static_cast<double>(k * bin) /
                                         static_cast<double>(last));
    change[bin] = std::exp(mean[bin]) * std::expm1(2.0 * log_gain);
  }
  const auto band = changed_band(change, bin_hz);
  return fmt::format("a nameless filter that {} mostly from {:.3g} to {:.3g} Hz",
                     band.adds ? "adds power" : "takes power away", band.from_hz, band.to_hz);
}

}  // namespace

std::optional<Nameless> filter_part(const Replicated& replicated, double rate_hz) {
  const auto& own = replicated.recording.log_density;
  if (own.size() < 16) return std::nullopt;
  const auto n = static_cast<double>(replicated.replicas.size());
  std::vector<double> mean(own.size(), 0.0);
  for (const auto& replica : replicated.replicas)
    for (std::size_t bin = 0; bin < mean.size(); ++bin) mean[bin] += replica.log_density[bin] / n;
  // Slower than the fast part there is nothing to filter; the lowest two bins have the window's.
  const double bin_hz = 0.5 * rate_hz / static_cast<double>(own.size() - 1);
  const double slowest_hz = 1.0 / (2.0 * std::numbers::pi * FastPart::window_s);
  const auto first = static_cast<std::size_t>(std::max(2.0, std::ceil(slowest_hz / bin_hz)));
  if (first >= own.size()) return std::nullopt;
  const Cepstrum observed = cepstrum_of(own, mean, first);
  std::array<std::vector<double>, coefficients> replicas;
  for (const auto& replica : replicated.replicas) {
    const auto c = cepstrum_of(replica.log_density, mean, first);
    for (std::size_t k = 0; k < coefficients; ++k) replicas[k].push_back(c[k]);
  }
  std::array<double, coefficients> variance{};
  double typical = 0.0;
  for (std::size_t k = 0; k < coefficients; ++k) {
    variance[k] = Against(0.0, replicas[k]).variance;
    if (k > 0) typical += variance[k] / static_cast<double>(coefficients - 1);
  }
  // One of a few replicas is uncertain; coefficients but the first have much the same.
  constexpr double shared = 6.0;
  std::size_t order = 0;
  double gain = 0.0, most = -1e300;
  for (std::size_t k = 0; k < coefficients; ++k) {
    const double of_k =
        k == 0 ? variance[0] : ((n - 1.0) * variance[k] + shared * typical) / (n - 1.0 + shared);
    gain += 0.5 * observed[k] * observed[k] / of_k - 1.0;
    if (gain > most) most = gain, order = k;
  }
  if (most < clear_gain) return std::nullopt;
  Effect effect = effects::EmpiricalFilter::absent();
  for (std::size_t k = 0; k <= order; ++k) effect.value(k) = observed[k];
  return Nameless{effect, in_words(observed, order, mean, first, bin_hz)};
}

}  // namespace gyrostat::gap
