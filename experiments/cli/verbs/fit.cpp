#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/analysis/fits/arima_intervals.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>
#include <gyrostat/experiments/cli/picture_option.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/allan_table.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* fit_examples = R"(Examples:
  gyrostat fit REC.csv
  gyrostat fit REC.csv --json FIT.json --svg ALLAN.svg     for programs; a picture
  gyrostat fit REC.csv --axis z --from 60 --to 600 --method likelihood
  gyrostat fit LOG.csv --columns t=Time,gyro=GyrZ,temp=Temp --units t=us,gyro=mdps,temp=F)";

struct FitArguments {
  RecordingOption recording;
  FormatOption format;
  std::vector<std::string> methods = {"likelihood", "moments"};
  SpanOption span;
  PictureOption picture;
  std::string json;
};

using Intervals = std::vector<std::array<double, 2>>;

template <class P>
void add_rows(Table& table, const std::string& method, const P& fitted, const P& errors,
              const Intervals& intervals) {
  std::size_t i = 0;
  for (const auto& field : P::fields()) {
    const auto [from, to] = i < intervals.size() ? intervals[i++] : std::array{no_value, no_value};
    table.rows.push_back({method, std::string(field.name), std::string(field.unit),
                          fitted.*(field.member), cell(from), cell(to),
                          cell(errors.*(field.member)), std::string(field.doc)});
  }
}

/// Where the likelihood has other maxima nearly as high, standard errors about one of them say
/// nothing: they are taken out, and the fit's message tells.
Intervals likelihood_intervals(const Series& series, Calibration& fit) {
  const auto rate = without_drift(series, fit.thermal);
  const ArimaIntervals likelihood(fit.random_error, rate);
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

/// Of the rate without its drift; none where samples are missing or too few.
std::optional<AllanCoefficients> coefficients_of(const std::vector<double>& rate, double rate_hz) {
  constexpr std::size_t fewest = 128;
  if (rate.size() < fewest ||
      std::any_of(rate.begin(), rate.end(), [](double v) { return is_missing(v); }))
    return {};
  return fit_allan_coefficients(rate, rate_hz);
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

int run(const FitArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  std::vector<FitMethod> methods;
  for (const auto& name : arguments.methods) methods.push_back(fit_method_named(name, "--method"));
  arguments.picture.check(arguments.recording.file);
  if (!arguments.json.empty()) require_writable(arguments.json, arguments.recording.file);
  const Series series = arguments.recording.read(console.log, arguments.span);
  constexpr std::size_t takes_seconds = 50'000;
  std::optional<PhaseProgress> progress;
  if (series.size() >= takes_seconds) progress.emplace(console.log, console.log_is_terminal, "fit");
  Json json = {{"recording", arguments.recording.file},
               {"axis", arguments.recording.axis},
               {"samples", series.size()},
               {"duration_s", series.duration_s()},
               {"rate_hz", series.rate_hz()}};

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
  std::vector<double> rate;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto& name = arguments.methods[m];
    const double share = static_cast<double>(m) / static_cast<double>(methods.size());
    if (progress) progress->set(name, "", share);
    auto fit = about(arguments.recording.file, [&] { return calibrate(series, methods[m]); });
    auto& error = fit.random_error;
    const bool by_likelihood = methods[m] == FitMethod::likelihood;
    if (progress && by_likelihood) progress->set(name + ", intervals", "", share + 0.1);
    const auto intervals = error.cluster > 1
                               ? normal_intervals(error.parameters, error.standard_errors)
                           : by_likelihood ? likelihood_intervals(series, fit)
                                           : Intervals{};
    add_rows(table, name, error.parameters, error.standard_errors, intervals);
    table.notes.push_back(name + ": " + error.message);
    json[name] = keys_and_values(error.parameters, error.standard_errors, intervals);
    json[name]["converged"] = error.converged;
    json[name]["message"] = error.message;
    converged = converged && error.converged;
    if (m > 0) continue;
    rate = without_drift(series, fit.thermal);
    if (!fit.thermal) continue;
    const auto& thermal = *fit.thermal;
    const auto of_thermal = normal_intervals(thermal.parameters, thermal.standard_errors);
    add_rows(table, "least squares", thermal.parameters, thermal.standard_errors, of_thermal);
    json["thermal"] = keys_and_values(thermal.parameters, thermal.standard_errors, of_thermal);
    table.notes.push_back(fmt::format("thermal drift: {}, {} points over {:.3g} °C",
                                      thermal.message, thermal.points, thermal.temperature_span_C));
  }
  progress.reset();
  table.notes.push_back(
      "from, to: 95 % interval, by profile likelihood of all four parameters or, of the drift and "
      "beside coloured noise, by the standard error");
  std::vector<Table> tables = {std::move(table)};
  const auto coefficients = coefficients_of(rate, series.rate_hz());
  if (coefficients) {
    tables.push_back(allan_coefficients_table(*coefficients, arguments.recording.file));
    json["allan"] = keys_and_values(*coefficients);
  }
  if (arguments.picture.wanted())
    arguments.picture.write(
        arguments.recording.file,
        recording_allan_picture(overlapping_allan_deviation(rate, series.rate_hz()), coefficients,
                                arguments.recording.file + ": Allan deviation without drift"),
        tables);
  if (!arguments.json.empty()) write_atomically(arguments.json, json.dump(1) + '\n');
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
  verb->add_option("--json", arguments->json, "write all values under their names")
      ->type_name("FILE");
  arguments->picture.add_to(verb);
  verb->footer(fit_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
