#include <cmath>

#include "experiments/calibration.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/cli/verbs.hpp"

namespace gyrostat::cli {
namespace {

constexpr const char* examples = R"(Examples:
  gyrostat fit REC.csv
  gyrostat fit REC.csv --axis z --from 60 --to 600 --method likelihood
  gyrostat fit LOG.csv --columns t=Time,gyro=GyrZ,temp=Temp --units t=us,gyro=mdps,temp=F)";

struct FitArguments {
  RecordingOption recording;
  FormatOption format;
  std::vector<std::string> methods = {"likelihood", "moments"};
  SpanOption span;
};

template <class P>
void add_rows(Table& table, const std::string& method, const P& fitted, const P& errors) {
  for (const auto& field : P::fields())
    table.rows.push_back({method, std::string(field.name), std::string(field.unit),
                          fitted.*(field.member), errors.*(field.member), std::string(field.doc)});
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
                          {"standard error", ""},
                          {"meaning", ""}},
              .rows = {},
              .notes = {}};
  bool converged = true;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto fit = about(arguments.recording.file, [&] { return calibrate(series, methods[m]); });
    add_rows(table, arguments.methods[m], fit.random_error.parameters,
             fit.random_error.standard_errors);
    table.notes.push_back(arguments.methods[m] + ": " + fit.random_error.message);
    converged = converged && fit.random_error.converged;
    if (!fit.thermal || m > 0) continue;
    add_rows(table, "least squares", fit.thermal->parameters, fit.thermal->standard_errors);
    table.notes.push_back(fmt::format("thermal drift: {}, {} points over {:.3g} °C",
                                      fit.thermal->message, fit.thermal->points,
                                      fit.thermal->temperature_span_C));
  }
  console.out << render(std::span(&table, 1), format);
  return converged ? complete : error;
}

}  // namespace

void add_fit(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "fit", "fit phi, delta1, delta2, R (and a, b, c) to a recording, with standard errors");
  auto arguments = std::make_shared<FitArguments>();
  arguments->recording.add_to(verb);
  verb->add_option("--method", arguments->methods, "likelihood, moments or both")->delimiter(',');
  arguments->span.add_to(verb);
  arguments->format.add_to(verb);
  verb->footer(examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
