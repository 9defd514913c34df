#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/analysis/fits/arima_intervals.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/allan_table.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* fit_examples = R"(Examples:
  gyrostat fit REC.csv
  gyrostat fit REC.csv --axis z --from 60 --to 600 --method likelihood
  gyrostat fit LOG.csv --columns t=Time,gyro=GyrZ,temp=Temp --units t=us,gyro=mdps,temp=F)";

struct FitArguments {
  RecordingOption recording;
  FormatOption format;
  std::vector<std::string> methods = {"likelihood", "moments"};
  SpanOption span;
};

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
  const auto fitted = std::span(rate).subspan(fit.random_error.first, fit.random_error.samples);
  const ArimaIntervals likelihood(fit.random_error, fitted);
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

int run(const FitArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  std::vector<FitMethod> methods;
  for (const auto& name : arguments.methods) methods.push_back(fit_method_named(name, "--method"));
  const Series series = arguments.recording.read(console.log, arguments.span);

  Table table{.title = fmt::format(
                  "{}{}: {} samples, {:.6g} s at {:.6g} Hz", arguments.recording.file,
                  arguments.recording.axis.empty() ? "" : " axis " + arguments.recording.axis,
                  series.size(), series.duration_s(), series.rate_hz()),
              .columns = {{"fit", ""},
                          {"parameter", ""},
                          {"unit", ""},
                          {"value", ""},
                          {"from", ""},
                          {"to", ""},
                          {"standard error", ""},
                          {"meaning", ""}}};
  bool converged = true;
  std::vector<Table> tables;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto fit = about(arguments.recording.file, [&] { return calibrate(series, methods[m]); });
    const bool by_likelihood = methods[m] == FitMethod::likelihood;
    add_rows(table, arguments.methods[m], fit.random_error.parameters,
             fit.random_error.standard_errors,
             fit.random_error.cluster > 1
                 ? normal_intervals(fit.random_error.parameters, fit.random_error.standard_errors)
             : by_likelihood ? likelihood_intervals(series, fit)
                             : Intervals{});
    table.notes.push_back(arguments.methods[m] + ": " + fit.random_error.message);
    converged = converged && fit.random_error.converged;
    if (m == 0) tables = coefficient_tables(series, fit.thermal, arguments.recording.file);
    if (!fit.thermal || m > 0) continue;
    add_rows(table, "least squares", fit.thermal->parameters, fit.thermal->standard_errors,
             normal_intervals(fit.thermal->parameters, fit.thermal->standard_errors));
    table.notes.push_back(fmt::format("thermal drift: {}, {} points over {:.3g} °C",
                                      fit.thermal->message, fit.thermal->points,
                                      fit.thermal->temperature_span_C));
  }
  table.notes.push_back(
      "from, to: 95 % interval, by profile likelihood of all four parameters or, of the drift and "
      "beside coloured noise, by the standard error");
  tables.insert(tables.begin(), std::move(table));
  console.out << render(tables, format);
  return converged ? complete : error;
}

}  // namespace

void add_fit(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "fit", "fit phi, delta1, delta2, R (and a, b, c) to a recording, with 95 % intervals");
  auto arguments = std::make_shared<FitArguments>();
  arguments->recording.add_to(verb);
  verb->add_option("--method", arguments->methods, "likelihood, moments or both")->delimiter(',');
  arguments->span.add_to(verb);
  arguments->format.add_to(verb);
  verb->footer(fit_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
