#include <gyrostat/experiments/findings/fit_tables.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <gyrostat/analysis/fits/arima_intervals.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/experiments/findings/told.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

using Intervals = std::vector<std::array<double, 2>>;

template <class P>
void add_rows(Table& table, const std::string& method, const P& fitted, const P& errors,
              const Intervals& intervals) {
  std::size_t i = 0;
  for (const auto& field : P::fields()) {
    const auto [from, to] = i < intervals.size() ? intervals[i++] : std::array{no_value, no_value};
    table.rows.push_back({method, std::string(field.name), std::string(field.unit),
                          fitted.*(field.member), told(from), told(to),
                          told(errors.*(field.member)), std::string(field.doc)});
  }
}

/// Where the likelihood has other maxima nearly as high, standard errors about one of them say
/// nothing: they are taken out, and the fit's message tells.
Intervals likelihood_intervals(const Series& series, Calibration& fit) {
  const auto rate = without_drift(series, fit.thermal);
  const auto fitted = std::span(rate).subspan(fit.random_error.first, fit.random_error.samples);
  const ArimaIntervals likelihood(fit.random_error, fitted);
  if (!likelihood.other_modes().empty() && std::isfinite(fit.random_error.standard_errors.phi)) {
    std::vector<std::string> others;
    for (const auto& mode : likelihood.other_modes())
      others.push_back(
          fmt::format("phi = {:.2f} (deviance {:.1f})", mode.parameters.phi, mode.deviance));
    fit.random_error.message += fmt::format(
        "; the likelihood has several maxima: {} {} not rejected either, so the intervals span "
        "all, and there are no standard errors",
        fmt::join(others, " and "), others.size() == 1 ? "is" : "are");
    fit.random_error.standard_errors = {no_value, no_value, no_value, no_value};
  }
  Intervals intervals(4);
  tbb::parallel_for(0, 4, [&](int p) {
    intervals[static_cast<std::size_t>(p)] =
        likelihood.interval(static_cast<ArimaIntervals::Parameter>(p));
  });
  return intervals;
}

template <class P>
Intervals normal_intervals(const P& fitted, const P& errors) {
  constexpr double reach = 1.959963984540054;
  Intervals intervals;
  for (const auto& field : P::fields()) {
    const double error = errors.*(field.member);
    intervals.push_back({std::max(field.range.from, fitted.*(field.member) - reach * error),
                         std::min(field.range.to, fitted.*(field.member) + reach * error)});
  }
  return intervals;
}

/// Values, intervals and standard errors by their names; null where there is none.
template <class P>
Json keys_and_values(const P& fitted, const P& errors, const Intervals& intervals) {
  Json json;
  std::size_t i = 0;
  for (const auto& field : P::fields()) {
    const auto [from, to] = i < intervals.size() ? intervals[i++] : std::array{no_value, no_value};
    json[std::string(field.name)] = {{"value", fitted.*(field.member)},
                                     {"from", from},
                                     {"to", to},
                                     {"standard_error", errors.*(field.member)},
                                     {"unit", field.unit}};
  }
  return json;
}

Json keys_and_values(const AllanCoefficients& c) {
  Json json;
  for (const auto& [name, one] :
       {std::pair{"quantisation_deg", c.quantisation_deg},
        {"angle_random_walk_dps_per_sqrt_hz", c.angle_random_walk_dps_per_sqrt_hz},
        {"bias_instability_dps", c.bias_instability_dps},
        {"rate_random_walk_dps_sqrt_hz", c.rate_random_walk_dps_sqrt_hz},
        {"rate_ramp_dps_per_s", c.rate_ramp_dps_per_s}})
    json[name] = {{"value", one.value}, {"from", one.lower}, {"to", one.upper}};
  return json;
}

/// Of the rate without its drift; nothing where samples are missing or too few.
AllanFindings left_by_drift(const Series& series, const std::optional<ThermalFit>& thermal,
                            const std::string& name) {
  constexpr std::size_t fewest = 4;
  const auto rate = without_drift(series, thermal);
  if (rate.size() < fewest ||
      std::any_of(rate.begin(), rate.end(), [](double v) { return is_missing(v); }))
    return {};
  return allan_findings(rate, series.rate_hz(), name);
}

Calibration fitted(const Series& series, FitMethod method, const std::string& name) {
  try {
    return calibrate(series, method);
  } catch (const InputError& mistake) {
    throw InputError(name, mistake.what());
  }
}

}  // namespace

FitTables fit_tables(const Series& series, std::span<const FitMethod> methods,
                     const std::string& name, const std::string& title,
                     const FitProgress& progress) {
  FitTables found;
  Table table{.title = fmt::format("{}: {} samples, {:.6g} s at {:.6g} Hz", title, series.size(),
                                   series.duration_s(), series.rate_hz()),
              .columns = {{"fit", ""},
                          {"parameter", ""},
                          {"unit", ""},
                          {"value", ""},
                          {"from", ""},
                          {"to", ""},
                          {"standard error", ""},
                          {"meaning", ""}}};
  Json json = Json::object();
  for (const auto method : methods) {
    const bool is_first = found.fits.empty();
    const bool by_likelihood = method == FitMethod::likelihood;
    const std::string called = by_likelihood ? "likelihood" : "moments";
    const double share =
        static_cast<double>(found.fits.size()) / static_cast<double>(methods.size());
    if (progress) progress(called, share);
    try {
      found.fits.push_back(fitted(series, method, name));
    } catch (const InputError& mistake) {
      if (is_first) throw;  // another method could do with what there is
      table.notes.push_back(fmt::format("{} left out: {}", called, mistake.what()));
      continue;
    }
    auto& fit = found.fits.back();
    auto& error = fit.random_error;
    if (progress && by_likelihood) progress(called + ", intervals", share + 0.1);
    const auto intervals = error.cluster > 1
                               ? normal_intervals(error.parameters, error.standard_errors)
                           : by_likelihood ? likelihood_intervals(series, fit)
                                           : Intervals{};
    add_rows(table, called, error.parameters, error.standard_errors, intervals);
    table.notes.push_back(called + (error.converged ? ": " : ": did not converge: ") +
                          error.message);
    json[called] = keys_and_values(error.parameters, error.standard_errors, intervals);
    json[called]["converged"] = error.converged;
    json[called]["message"] = error.message;
    found.converged = found.converged || error.converged;
    if (!is_first) continue;
    found.left = left_by_drift(series, fit.thermal, name);
    if (!fit.thermal) continue;
    const auto& thermal = *fit.thermal;
    const auto of_thermal = normal_intervals(thermal.parameters, thermal.standard_errors);
    add_rows(table, "least squares", thermal.parameters, thermal.standard_errors, of_thermal);
    json["thermal"] = keys_and_values(thermal.parameters, thermal.standard_errors, of_thermal);
    table.notes.push_back(fmt::format("thermal drift: {}, {} points over {:.3g} °C",
                                      thermal.message, thermal.points, thermal.temperature_span_C));
  }
  table.notes.push_back(
      "from, to: 95 % interval, by profile likelihood of all four parameters or, of the drift and "
      "beside coloured noise, by the standard error");
  found.tables = {std::move(table)};
  if (found.left.coefficients) {
    found.tables.push_back(allan_coefficients_table(*found.left.coefficients, name));
    json["allan"] = keys_and_values(*found.left.coefficients);
  }
  found.json = json.dump();
  return found;
}

}  // namespace gyrostat
