#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/models/model_format.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* export_model_examples = R"(Examples:
  gyrostat export-model REC.csv --for kalibr --out imu.yaml
  gyrostat export-model GAP.json --for gazebo           of what diagnose --json wrote
  gyrostat export-model GAP.json --for px4 --inflate --averaging 0.5
  gyrostat export-model STUDY.json --cell ramp --for all --out FOLDER)";

struct ExportModelArguments {
  RecordingOption source;
  SpanOption span;
  std::string to, out, cell;
  ModelOptions options;
};

SensorModel model_of(const ExportModelArguments& arguments, Console& console) {
  const auto& file = arguments.source.file;
  if (fs::path(file).extension() == ".json") return read_model(file, arguments.cell);
  if (!arguments.cell.empty())
    throw InputError("--cell", "chooses a cell of a study, and " + file + " is a recording");
  const Series series = arguments.source.read(console.log, arguments.span);
  auto model = about(file, [&] { return model_of_recording(series); });
  model.source = fs::path(file).filename().string();
  if (!arguments.source.axis.empty()) model.source += ", axis " + arguments.source.axis;
  model.source += fmt::format(": the Allan deviation of {:.6g} s", series.duration_s());
  return model;
}

int run(const ExportModelArguments& arguments, Console& console) {
  const bool all = arguments.to == "all";
  if (!all) (void)model_format_named(arguments.to, "--for");
  if (all && arguments.out.empty())
    throw InputError("--for all", "needs --out, the folder to write the files to");
  if (!all && !arguments.out.empty()) require_writable(arguments.out, arguments.source.file);
  const auto model = model_of(arguments, console);
  if (!(model.N.value > 0.0))
    throw InputError(arguments.source.file,
                     "shows no white noise (N is 0): there is nothing to export");
  if (all) {
    make_result_folder(arguments.out);
    for (const auto& format : model_formats())
      write_atomically(fs::path(arguments.out) / format.file,
                       write_model(model, format, arguments.options));
    return complete;
  }
  const auto text =
      write_model(model, model_format_named(arguments.to, "--for"), arguments.options);
  if (arguments.out.empty())
    console.out << text;
  else
    write_atomically(arguments.out, text);
  return complete;
}

std::string model_format_names() {
  std::string names = "all";
  for (const auto& format : model_formats()) names += fmt::format(", {}", format.id);
  return names;
}

}  // namespace

void add_export_model(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "export-model", "write a gyro's noise for other simulators and filters, with what they lack");
  auto arguments = std::make_shared<ExportModelArguments>();
  arguments->source.add_to(verb);
  verb->get_option("recording")
      ->description("a recording at rest, a diagnosis (JSON) or a study (JSON)");
  arguments->span.add_to(verb);
  verb->add_option("--for", arguments->to, model_format_names())->required();
  verb->add_option("--out", arguments->out,
                   "file to write (default: to the terminal); of all, a folder");
  verb->add_option("--cell", arguments->cell, "cell of the study (default: the first)");
  verb->add_option("--averaging", arguments->options.averaging_s,
                   "averaging time, s, up to which an inflation of N is to cover what is left out")
      ->check(within(1e-6, 1e6, "s"))
      ->capture_default_str();
  verb->add_flag("--inflate", arguments->options.inflate, "write N so inflated");
  verb->footer(export_model_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
