#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/fit_tables.hpp>

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

int run(const FitArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  std::vector<FitMethod> methods;
  for (const auto& name : arguments.methods) methods.push_back(fit_method_named(name, "--method"));
  const Series series = arguments.recording.read(console.log, arguments.span);

  const auto& recording = arguments.recording;
  const auto found =
      fit_tables(series, methods, recording.file,
                 recording.file + (recording.axis.empty() ? "" : " axis " + recording.axis));
  console.out << render(found.tables, format);
  return found.converged ? complete : error;
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
