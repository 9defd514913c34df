#include <gyrostat/diagnosis/likelihood/nameless_mean.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/generators/effects/empirical_mean_over_rate.hpp>
#include <gyrostat/generators/effects/empirical_mean_over_temperature.hpp>
#include <gyrostat/generators/linear_spline.hpp>

namespace gyrostat::gap {
namespace {

/// One knot's share of a spline of so many knots.
LinearSpline unit_spline(double from, double span, std::size_t knots, std::size_t knot) {
  LinearSpline spline{from, span, {}};
  const std::size_t apart = (LinearSpline::knots - 1) / (knots - 1);
  for (std::size_t k = 0; k < LinearSpline::knots; ++k) {
    const auto steps = static_cast<double>(k) - static_cast<double>(knot * apart);
    spline.values[k] = std::max(0.0, 1.0 - std::abs(steps) / static_cast<double>(apart));
  }
  return spline;
}

struct Found {
  double gain = -1e300;
  LinearSpline spline;
  Arima111<double> random_error;
};

/// The mean along `x`, a value a sample, that the recording is likeliest with.
Found likeliest_mean(const Conditions& conditions, const SetFitter& fitter, const Scenario& set,
                     const std::vector<double>& x) {
  double from = 1e300, to = -1e300;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(x[i])) from = std::min(from, x[i]), to = std::max(to, x[i]);
  Found best;
  if (!(to > from)) return best;
  constexpr int iterations = 6;
  const double without = fitter.maximise(set, iterations, Jumping::no).log_likelihood;
  for (const std::size_t knots : {3, 5, 9}) {
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(conditions.slow_size()),
                            static_cast<Eigen::Index>(knots));
    for (std::size_t k = 0; k < knots; ++k) {
      std::vector<double> values(x.size());
      std::transform(x.begin(), x.end(), values.begin(), unit_spline(from, to - from, knots, k));
      const auto means = conditions.slow_means(values);
      auto column = columns.col(static_cast<Eigen::Index>(k));
      std::transform(means.begin(), means.end(), column.begin(),
                     [](double mean) { return is_missing(mean) ? 0.0 : mean; });
    }
    const auto beside = fitter.beside(columns);
    const auto fit = beside.maximise(with_walk_times(set, 0.1), iterations, Jumping::no);
    if (fit.log_likelihood - without <= best.gain) continue;
    best = {fit.log_likelihood - without, {from, to - from, {}}, fit.scenario.random_error};
    const Eigen::VectorXd heights = beside.further_sizes(fit.scenario);
    for (std::size_t k = 0; k < knots; ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const auto unit = unit_spline(from, to - from, knots, k);
      for (std::size_t j = 0; j < LinearSpline::knots; ++j)
        best.spline.values[j] += heights[at] * (unit.values[j] - columns.col(at).mean());
    }
  }
  return best;
}

template <class Mean>
std::optional<Nameless> part_of(const Found& found, std::string_view over, std::string_view unit) {
  if (found.gain < clear_gain) return std::nullopt;
  Effect effect = Mean{};
  effect.value(0) = found.spline.from;
  effect.value(1) = found.spline.span;
  for (std::size_t k = 0; k < LinearSpline::knots; ++k)
    effect.value(2 + k) = found.spline.values[k];
  const auto [low, high] =
      std::minmax_element(found.spline.values.begin(), found.spline.values.end());
  return Nameless{
      effect,
      fmt::format("a mean without a name over the {}, {:.2g} dps from its lowest to its "
                  "highest between {:.3g} and {:.3g} {}",
                  over, *high - *low, found.spline.from, found.spline.from + found.spline.span,
                  unit),
      found.random_error};
}

}  // namespace

std::optional<Nameless> mean_over_temperature(const Conditions& conditions, const SetFitter& fitter,
                                              const Scenario& set) {
  const auto& x = conditions.series().temperature_C;
  if (x.empty()) return std::nullopt;
  return part_of<effects::EmpiricalMeanOverTemperature>(likeliest_mean(conditions, fitter, set, x),
                                                        "temperature", "°C");
}

std::optional<Nameless> mean_over_rate(const Conditions& conditions, const SetFitter& fitter,
                                       const Scenario& set) {
  const auto& x = conditions.series().rate_ref_dps;
  if (!conditions.has_motion()) return std::nullopt;
  return part_of<effects::EmpiricalMeanOverRate>(likeliest_mean(conditions, fitter, set, x), "rate",
                                                 "dps");
}

bool is_mean_without_name(const Effect& effect) {
  return effect.as<effects::EmpiricalMeanOverTemperature>() != nullptr ||
         effect.as<effects::EmpiricalMeanOverRate>() != nullptr;
}

}  // namespace gyrostat::gap
