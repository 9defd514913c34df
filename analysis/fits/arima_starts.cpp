#include <gyrostat/analysis/fits/arima_starts.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/analysis/fits/arima_sums.hpp>
#include <gyrostat/analysis/fits/arima_whittle.hpp>
#include <gyrostat/analysis/fits/fisher_scoring.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_starts = 3;

/// What concentrating out the scale leaves of the deviance of each term.
double concentrated(const ArimaSums& sums) {
  return std::log(sums.squares / sums.count) + sums.logs / sums.count;
}

struct Start {
  ArimaShape shape;
  double delta1, objective;
};

/// Of many starts, best first, where the spectrum leads the best of them.
std::vector<ArimaShape> led_by(const ArimaWhittle& spectrum, std::span<const Start> starts) {
  constexpr std::size_t most_led = 6;
  constexpr double within = 0.99;  // of the limits
  std::vector<std::array<double, 4>> from;
  for (const auto& [shape, delta1, objective] : starts.first(std::min(starts.size(), most_led)))
    from.push_back({shape[0], shape[1], shape[2], std::log(delta1)});
  const auto ends = descend<4>(
      from,
      [](const auto* u) {
        using std::exp;
        auto model = unit_arima(u);
        const auto delta1 = exp(u[3]);
        return Arima111{model.phi, delta1, model.delta2_dps * delta1,
                        model.measurement_noise_std_dps * delta1};
      },
      spectrum);
  std::vector<ArimaShape> shapes;
  for (const auto& u : different_ends<4>(ends, most_starts))
    shapes.push_back(
        {std::clamp(u[0], -within * ArimaLimits::shape, within * ArimaLimits::shape),
         std::clamp(u[1], -within * ArimaLimits::shape, within * ArimaLimits::shape),
         std::clamp(u[2], -within * ArimaLimits::log_ratio, within * ArimaLimits::log_ratio)});
  return shapes;
}

}  // namespace

std::vector<ArimaShape> arima_starts(std::span<const double> z, const ArimaVariant& variant) {
  std::vector<ArimaShape> shapes;
  for (const double phi : {-0.6, 0.0, 0.6, 0.9})
    for (const double theta : {-0.6, 0.0, 0.7, 0.95})
      for (const double log_ratio : {-ArimaLimits::log_ratio, -1.0, 1.0, 2.5, 4.5, 6.5}) {
        if ((!variant.phi && phi != 0.0) || (!variant.theta && theta != 0.0) ||
            (variant.noise == (log_ratio == -ArimaLimits::log_ratio)))
          continue;
        shapes.push_back({std::atanh(phi), std::atanh(theta), log_ratio});
      }
  std::vector<Arima111<double>> models;
  for (const auto& shape : shapes) models.push_back(unit_arima(shape.data()));
  const auto sums = arima_sums(models, z);
  std::vector<Start> starts;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    starts.push_back(
        {shapes[i], std::sqrt(sums[i].squares / sums[i].count), concentrated(sums[i])});
  std::sort(starts.begin(), starts.end(),
            [](const Start& a, const Start& b) { return a.objective < b.objective; });
  if (variant.held() == 0)
    if (const ArimaWhittle spectrum(z); spectrum.has_terms()) return led_by(spectrum, starts);
  std::vector<ArimaShape> best;
  for (std::size_t i = 0; i < std::min(starts.size(), most_starts); ++i)
    best.push_back(starts[i].shape);
  return best;
}

}  // namespace gyrostat
