#include <gyrostat/analysis/fits/arima_profile.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gyrostat/analysis/fits/fisher_scoring.hpp>

namespace gyrostat {
namespace {

using Parameter = ArimaProfile::Parameter;
/// What is free beside the held parameter, each over all real numbers.
using Free = std::array<double, 3>;

constexpr double smallest = 1e-9;  ///< of a standard deviation beside the largest of the model
constexpr std::size_t most_descents = 3, most_by_spectrum = 6;
/// Half the deviance of a point that the exact likelihood is not asked about.
constexpr double far = 100.0;

/// The model with one parameter held at `value`. |delta2| < delta1 throughout.
template <class T>
Arima111<T> model(Parameter held, double value, const T* u) {
  using std::exp;
  using std::sqrt;
  using std::tanh;
  const T v(value);
  switch (held) {
    case Parameter::phi: {
      const T delta1 = exp(u[0]);
      return {v, delta1, tanh(u[1]) * delta1, exp(u[2])};
    }
    case Parameter::delta1:
      return {tanh(u[0]), v, tanh(u[1]) * v, exp(u[2])};
    case Parameter::delta2:
      return {tanh(u[0]), sqrt(v * v + exp(T(2.0) * u[1])), v, exp(u[2])};
    default: {
      const T delta1 = exp(u[1]);
      return {tanh(u[0]), delta1, tanh(u[2]) * delta1, v};
    }
  }
}

/// Where `model` has these parameters, as nearly as it can.
Free coordinates(Parameter held, const Arima111<double>& p) {
  const double scale = std::hypot(p.delta1_dps, p.measurement_noise_std_dps);
  const auto log_of = [&](double std) { return std::log(std::max(std, smallest * scale)); };
  const auto inverse = [](double v) { return std::atanh(std::clamp(v, -0.9999, 0.9999)); };
  const double theta = p.delta1_dps > 0.0 ? p.theta() : 0.0;
  switch (held) {
    case Parameter::phi:
      return {log_of(p.delta1_dps), inverse(theta), log_of(p.measurement_noise_std_dps)};
    case Parameter::delta1:
      return {inverse(p.phi), inverse(theta), log_of(p.measurement_noise_std_dps)};
    case Parameter::delta2:
      return {inverse(p.phi), log_of(p.delta1_dps * std::sqrt(std::max(0.0, 1.0 - theta * theta))),
              log_of(p.measurement_noise_std_dps)};
    default:
      return {inverse(p.phi), log_of(p.delta1_dps), inverse(theta)};
  }
}

/// The `most` with the least misfit, least first.
std::vector<Free> most_promising(std::span<const Free> from, std::span<const double> misfits,
                                 std::size_t most) {
  std::vector<std::pair<double, Free>> ranked;
  for (std::size_t i = 0; i < from.size(); ++i) ranked.emplace_back(misfits[i], from[i]);
  std::sort(ranked.begin(), ranked.end());
  ranked.resize(std::min(ranked.size(), most));
  std::vector<Free> promising;
  for (const auto& [misfit, u] : ranked) promising.push_back(u);
  return promising;
}

/// The likeliest of models all over what is possible, each at the scale that suits `z` best.
std::vector<Arima111<double>> likely_arima_models(std::span<const double> z) {
  constexpr std::size_t kept = 12;
  std::vector<Arima111<double>> grid;
  for (const double phi : {-0.6, 0.0, 0.6, 0.9})
    for (const double theta : {-0.9, -0.5, 0.0, 0.5, 0.9})
      for (const double noise : {0.01, 0.3, 1.0, 3.0, 10.0, 100.0, 1000.0})
        grid.push_back({phi, 1.0, theta, noise});
  const auto sums = arima_sums(grid, z);
  std::vector<std::pair<double, std::array<double, 4>>> models;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double scale = std::sqrt(sums[i].squares / sums[i].count);
    const auto& [phi, one, theta, noise] = grid[i];
    models.push_back({sums[i].logs + sums[i].count * std::log(sums[i].squares),
                      {phi, scale, theta * scale, noise * scale}});
  }
  std::sort(models.begin(), models.end());
  std::vector<Arima111<double>> likely;
  for (std::size_t k = 0; k < kept; ++k) {
    const auto& [phi, delta1, delta2, noise] = models[k].second;
    likely.push_back({phi, delta1, delta2, noise});
  }
  return likely;
}

}  // namespace

double arima_misfit(const ArimaSums& sums) {
  const double misfit = sums.misfit();
  return std::isfinite(misfit) ? misfit : std::numeric_limits<double>::infinity();
}

ArimaProfile::ArimaProfile(std::span<const double> rate_dps, const Arima111<double>& likeliest)
    : z_(rate_dps),
      spectrum_(rate_dps),
      starts_(likely_arima_models(rate_dps)),
      least_(arima_misfit(arima_sums(likeliest, rate_dps))),
      least_by_spectrum_(spectrum_.about(likeliest).value) {
  starts_.push_back(likeliest);
}

ArimaProfile::Point ArimaProfile::point(Parameter held, double value) const {
  const auto chart = [&](const auto* u) { return model(held, value, u); };
  std::vector<Free> at;
  std::vector<Arima111<double>> models;
  for (const auto& start : starts_) {
    at.push_back(coordinates(held, start));
    models.push_back(chart(at.back().data()));
  }
  std::vector<double> misfits;
  std::vector<Free> from;
  if (spectrum_.has_terms()) {
    for (const auto& one : models) misfits.push_back(spectrum_.about(one).value);
    const auto ends = descend<3>(most_promising(at, misfits, most_by_spectrum), chart, spectrum_);
    const double above = ends.front().misfit() - least_by_spectrum_;
    if (above > far) return {least_ + above, chart(ends.front().lowest().data())};
    from = different_ends<3>(ends, most_descents);
  } else {
    for (const auto& sums : arima_sums(models, z_)) misfits.push_back(arima_misfit(sums));
    from = most_promising(at, misfits, most_descents);
  }
  const auto ends = descend<3>(from, chart, [&](const std::vector<Arima111<double>>& next) {
    std::vector<ArimaMisfit> exact;
    for (const auto& found : arima_derivatives(next, z_))
      exact.push_back({found.sums.misfit(), found.gradient(), found.information});
    return exact;
  });
  return {ends.front().misfit(), chart(ends.front().lowest().data())};
}

}  // namespace gyrostat
