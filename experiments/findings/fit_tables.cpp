#include <gyrostat/experiments/findings/fit_tables.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/analysis/fits/arima_intervals.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/experiments/findings/allan_table.hpp>

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
                          fitted.*(field.member), cell(from), cell(to), errors.*(field.member),
                          std::string(field.doc)});
  }
}

Intervals likelihood_intervals(const Series& series, const Calibration& fit) {
  const auto rate = without_drift(series, fit.thermal);
  const ArimaIntervals likelihood(fit.random_error, rate);
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

/// Of the rate without its drift; nothing where samples are missing or too few.
std::vector<Table> coefficient_tables(const Series& series,
                                      const std::optional<ThermalFit>& thermal,
                                      const std::string& title) {
  constexpr std::size_t fewest = 128;
  const auto rate = without_drift(series, thermal);
  if (rate.size() < fewest ||
      std::any_of(rate.begin(), rate.end(), [](double v) { return is_missing(v); }))
    return {};
  return {allan_coefficients_table(fit_allan_coefficients(rate, series.rate_hz()), title)};
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
                     const std::string& name, const std::string& title) {
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
  for (const auto method : methods) {
    const bool is_first = found.fits.empty();
    const auto& fit = found.fits.emplace_back(fitted(series, method, name));
    const bool by_likelihood = method == FitMethod::likelihood;
    const std::string called = by_likelihood ? "likelihood" : "moments";
    add_rows(table, called, fit.random_error.parameters, fit.random_error.standard_errors,
             fit.random_error.cluster > 1
                 ? normal_intervals(fit.random_error.parameters, fit.random_error.standard_errors)
             : by_likelihood ? likelihood_intervals(series, fit)
                             : Intervals{});
    table.notes.push_back(called + ": " + fit.random_error.message);
    found.converged = found.converged && fit.random_error.converged;
    if (is_first) found.tables = coefficient_tables(series, fit.thermal, name);
    if (!fit.thermal || !is_first) continue;
    add_rows(table, "least squares", fit.thermal->parameters, fit.thermal->standard_errors,
             normal_intervals(fit.thermal->parameters, fit.thermal->standard_errors));
    table.notes.push_back(fmt::format("thermal drift: {}, {} points over {:.3g} °C",
                                      fit.thermal->message, fit.thermal->points,
                                      fit.thermal->temperature_span_C));
  }
  table.notes.push_back(
      "from, to: 95 % interval, by profile likelihood of all four parameters or, of the drift and "
      "beside coloured noise, by the standard error");
  found.tables.insert(found.tables.begin(), std::move(table));
  return found;
}

}  // namespace gyrostat
