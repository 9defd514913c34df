#include <array>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>
#include <gyrostat/experiments/cli/picture_option.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/fit_tables.hpp>
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

int run(const FitArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  std::vector<FitMethod> methods;
  for (const auto& name : arguments.methods) methods.push_back(fit_method_named(name, "--method"));
  arguments.picture.check(arguments.recording.file);
  if (!arguments.json.empty()) require_writable(arguments.json, arguments.recording.file);
  constexpr std::array<std::string_view, 5> wanted = {"gyro_dps", "rate_ref_dps", "temperature_C",
                                                      "heading_deg", "mag_valid"};
  const Series series = arguments.recording.read(console.log, arguments.span, wanted);
  constexpr std::size_t takes_seconds = 50'000;
  std::optional<PhaseProgress> progress;
  if (series.size() >= takes_seconds) progress.emplace(console.log, console.log_is_terminal, "fit");
  Json json = {{"recording", arguments.recording.file},
               {"axis", arguments.recording.axis},
               {"samples", series.size()},
               {"duration_s", series.duration_s()},
               {"rate_hz", series.rate_hz()}};

  const auto& recording = arguments.recording;
  const auto found =
      fit_tables(series, methods, recording.file,
                 recording.file + (recording.axis.empty() ? "" : " axis " + recording.axis),
                 [&](const std::string& phase, double share) {
                   if (progress) progress->set(phase, "", share);
                 });
  progress.reset();
  if (arguments.picture.wanted())
    arguments.picture.write(
        recording.file,
        allan_picture(found.left, recording.file + ": Allan deviation without drift"),
        found.tables);
  json.update(Json::parse(found.json));
  if (!arguments.json.empty()) write_atomically(arguments.json, json.dump(1) + '\n');
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
  verb->add_option("--json", arguments->json, "write all values under their names")
      ->type_name("FILE");
  arguments->picture.add_to(verb);
  verb->footer(fit_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
