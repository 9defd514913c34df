#include <gyrostat/experiments/cli/simulated.hpp>

#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/diagnosis/compare/comparison_text.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>
#include <gyrostat/experiments/findings/comparison_page.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/write_columns.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

/// "a.csv", or "a.csv and 3 more".
std::string first_and_more(const std::vector<std::string>& files) {
  const auto first = file_name(files.front());
  return files.size() == 1 ? first : fmt::format("{} and {} more", first, files.size() - 1);
}

std::vector<gap::NamedSeries> read_traces(const std::vector<std::string>& files,
                                          RecordingOption layout, const SpanOption& span,
                                          Console& console) {
  std::vector<gap::NamedSeries> traces;
  for (const auto& file : files) {
    layout.file = file;
    traces.push_back({file, layout.read(console.log, span)});
  }
  return traces;
}

/// Where each trace goes: its name, which no other may have.
std::vector<fs::path> places_of(const SimulatedArguments& arguments) {
  std::vector<fs::path> places;
  for (const auto& file : arguments.simulated) {
    const auto place = fs::path(arguments.out) / file_name(file);
    if (std::find(places.begin(), places.end(), place) != places.end())
      throw InputError("--out-simulated",
                       fmt::format("two traces are called '{}'; rename one", file_name(file)));
    std::error_code absent;
    if (fs::equivalent(place, file, absent))
      throw InputError("--out-simulated",
                       fmt::format("'{}' would be written over '{}'; choose another folder",
                                   place.string(), file));
    places.push_back(place);
  }
  return places;
}

}  // namespace

int diagnose_simulated(const SimulatedArguments& arguments, const RecordingOption& recording,
                       const SpanOption& span, const gap::ComparisonOptions& options, Format format,
                       Console& console) {
  std::vector<std::string> files = {recording.file};
  files.insert(files.end(), arguments.further.begin(), arguments.further.end());
  for (const auto& out : {arguments.json_out, arguments.html_out})
    if (!out.empty()) require_writable(out, recording.file);
  std::vector<fs::path> places;
  if (!arguments.out.empty()) places = places_of(arguments);
  const auto real = read_traces(files, recording, span, console);
  const auto simulated = read_traces(arguments.simulated, recording, {}, console);
  std::optional<gap::Comparison> comparison;
  {
    const Interrupt interrupt(console.stop.orderly(StopSignal::Done::is_discarded));
    PhaseProgress progress(console.log, console.log_is_terminal, "diagnose");
    try {
      comparison = gap::compare(
          real, simulated, options,
          [&](const auto& now) { progress.set(now.phase, now.detail, now.share); }, interrupt);
    } catch (const Interrupted&) {
      console.log << "stopped early: nothing was written\n";
      return stopped;
    }
  }
  const auto of_recordings = first_and_more(files), of_traces = first_and_more(arguments.simulated);
  if (!arguments.json_out.empty())
    write_atomically(arguments.json_out, gap::to_json(*comparison).dump(1) + '\n');
  if (!arguments.html_out.empty())
    write_atomically(arguments.html_out,
                     gap::comparison_page(*comparison, of_recordings, of_traces));
  if (!places.empty()) {
    if (comparison->with_added.empty())
      console.log << "nothing to add: no trace was written\n";
    else
      make_result_folder(arguments.out);
    for (std::size_t k = 0; k < comparison->with_added.size(); ++k)
      write_series(places[k], comparison->with_added[k]);
  }
  if (format == Format::text)
    console.out << gap::in_words(*comparison, of_recordings, of_traces) << '\n';
  console.out << render(gap::comparison_tables(*comparison), format);
  return complete;
}

}  // namespace gyrostat::cli
