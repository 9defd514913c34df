#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/application.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* apply_examples = R"(Examples:
  gyrostat apply REC.csv                               every method, fitted to the first quarter
  gyrostat apply REC.csv --calibration 0.5 --out COMP.csv
  gyrostat apply REC.csv --config C.json --out COMP.mat parameters from a file; series for MATLAB
  gyrostat apply LOG.csv --columns t=Time[ms],gyro=GyrZ[rad/s],temp=Temp[F])";

struct ApplyArguments {
  RecordingOption recording;
  FormatOption format;
  std::string config;
  std::string out;
  SpanOption span;
  std::string fit = "likelihood";
  double calibration_fraction = 0.25;
};

int run(const ApplyArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const auto fit = fit_method_named(arguments.fit, "--fit");
  std::vector<Method> methods = all_methods(ParameterSource::calibration);
  ParameterSource source = ParameterSource::calibration;
  if (!arguments.config.empty()) {
    source = ParameterSource::defaults;
    methods = read_application_config(arguments.config);
  }
  const Series series = arguments.recording.read(console.log, arguments.span);
  if (!arguments.out.empty()) require_writable(arguments.out, arguments.recording.file);

  Application application;
  if (source == ParameterSource::calibration) {
    application = about(arguments.recording.file,
                        [&] { return calibrated(series, arguments.calibration_fraction, fit); });
    console.log << fmt::format("parameters from the first {:.4g} s; judged on the rest\n",
                               application.judged_from_s);
  }
  about(arguments.recording.file,
        [&] { apply_methods(methods, series, console.log, application); });
  const auto tables = application_tables(series, application, arguments.recording.file);
  if (!arguments.out.empty()) write_application(arguments.out, series, application);
  console.out << render(tables, format);
  if (!arguments.out.empty()) console.log << "compensated series: " << arguments.out << '\n';
  return complete;
}

}  // namespace

void add_apply(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "apply", "run every applicable method over a recording: raw against compensated");
  auto arguments = std::make_shared<ApplyArguments>();
  arguments->recording.add_to(verb);
  auto* config = verb->add_option(
      "--config", arguments->config,
      "JSON {\"filters\": [{\"id\", \"filter\", \"parameters\"}]} instead of a fit");
  verb->add_option("--out", arguments->out,
                   "CSV, CSV.gz or MATLAB file for the series of every method");
  verb->add_option("--fit", arguments->fit, "likelihood or moments")
      ->excludes(config)
      ->capture_default_str();
  verb->add_option("--calibration", arguments->calibration_fraction,
                   "part of the recording that the fit may see, from its start")
      ->check(within(0.01, 0.99))
      ->excludes(config)
      ->capture_default_str();
  arguments->span.add_to(verb);
  arguments->format.add_to(verb);
  verb->footer(apply_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
