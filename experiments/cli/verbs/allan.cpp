#include <array>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/analysis/spectra/allan.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/picture_option.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/allan_table.hpp>
#include <gyrostat/experiments/findings/recording_page.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* allan_examples = R"(Examples:
  gyrostat allan REC.csv
  gyrostat allan REC.csv --html ALLAN.html --svg ALLAN.svg
  gyrostat allan REC.mat --axis z --format csv
  gyrostat allan LOG.csv.gz --columns t=Time[ms],gyro=GyrZ --units gyro=rad/s)";

struct AllanArguments {
  RecordingOption recording;
  FormatOption format;
  PictureOption picture;
};

int run(const AllanArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  constexpr std::array<std::string_view, 1> wanted = {"gyro_dps"};
  arguments.picture.check(arguments.recording.file);
  const Series series =
      arguments.recording.read(console.log, {}, wanted, RecordingOption::Bursts::taken);
  Table table{.title = arguments.recording.file + ": overlapping Allan deviation",
              .columns = {{"tau", "s"},
                          {"deviation", "dps"},
                          {"lower 95 %", "dps"},
                          {"upper 95 %", "dps"},
                          {"degrees of freedom", "1"}}};
  if (series.size() < 4)
    throw InputError(arguments.recording.file,
                     fmt::format("{} samples; at least 4 are needed", series.size()));
  const auto points = about(arguments.recording.file, [&] {
    return overlapping_allan_deviation(series.gyro_dps, series.rate_hz());
  });
  for (const auto& point : points)
    table.rows.push_back({point.tau_s, point.deviation, point.lower, point.upper, point.edf});
  std::vector<Table> tables = {std::move(table)};
  constexpr std::size_t fewest_for_coefficients = 128;
  std::optional<AllanCoefficients> coefficients;
  if (series.size() >= fewest_for_coefficients) {
    coefficients = fit_allan_coefficients(series.gyro_dps, series.rate_hz());
    tables.push_back(allan_coefficients_table(*coefficients, arguments.recording.file));
  }
  arguments.picture.write(
      arguments.recording.file,
      recording_allan_picture(points, coefficients, arguments.recording.file + ": Allan deviation"),
      tables);
  console.out << render(tables, format);
  return complete;
}

}  // namespace

void add_allan(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "allan", "overlapping Allan deviation of a recording, and its N, B and K");
  auto arguments = std::make_shared<AllanArguments>();
  arguments->recording.add_to(verb);
  arguments->format.add_to(verb);
  arguments->picture.add_to(verb);
  verb->footer(allan_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
