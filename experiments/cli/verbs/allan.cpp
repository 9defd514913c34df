#include <array>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/picture_option.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/allan_table.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* allan_examples = R"(Examples:
  gyrostat allan REC.csv
  gyrostat allan REC.csv --from 600 --to 4200        an hour, after ten minutes of warming up
  gyrostat allan REC.csv --html ALLAN.html --svg ALLAN.svg
  gyrostat allan REC.mat --axis z --format csv
  gyrostat allan LOG.csv.gz --columns t=Time[ms],gyro=GyrZ --units gyro=rad/s)";

struct AllanArguments {
  RecordingOption recording;
  SpanOption span;
  FormatOption format;
  PictureOption picture;
};

int run(const AllanArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  constexpr std::array<std::string_view, 1> wanted = {"gyro_dps"};
  arguments.picture.check(arguments.recording.file);
  const Series series =
      arguments.recording.read(console.log, arguments.span, wanted, RecordingOption::Bursts::taken);
  const auto& name = arguments.recording.file;
  const auto findings = allan_findings(series.gyro_dps, series.rate_hz(), name);
  const auto tables = allan_tables(findings, name);
  arguments.picture.write(name, allan_picture(findings, name + ": Allan deviation"), tables);
  console.out << render(tables, format);
  return complete;
}

}  // namespace

void add_allan(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "allan", "overlapping Allan deviation of a recording, and its N, B and K");
  auto arguments = std::make_shared<AllanArguments>();
  arguments->recording.add_to(verb);
  arguments->span.add_to(verb);
  arguments->format.add_to(verb);
  arguments->picture.add_to(verb);
  verb->footer(allan_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
