#pragma once

#include <algorithm>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat::cli {

/// `--format`, which every verb that prints tables has.
struct FormatOption {
  std::string name = "text";

  void add_to(CLI::App* verb) {
    verb->add_option("--format", name, "text, md, csv, json or latex")->capture_default_str();
  }
  Format get() const { return format_named(name); }
};

/// Runs `work`, whose complaints then name the file they are about.
template <class Work>
auto about(const std::string& file, const Work& work) {
  try {
    return work();
  } catch (const InputError& mistake) {
    throw InputError(file, mistake.what());
  }
}

/// A check of an option's value that also refuses nan.
inline CLI::Validator within(double low, double high) {
  return {
      [low, high](const std::string& text) {
        double value = 0.0;
        const bool fits = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return fits ? std::string{}
                    : fmt::format("'{}' is out of range; allowed: [{:g}, {:g}]", text, low, high);
      },
      "NUMBER"};
}

/// A span of the recording, in seconds from its first sample.
struct SpanOption {
  double from_s = 0.0;
  double to_s = 1e12;

  void add_to(CLI::App* verb) {
    verb->add_option("--from", from_s, "start of the span, s from the first sample")
        ->check(within(0.0, 1e12));
    verb->add_option("--to", to_s, "end of the span, s from the first sample")
        ->check(within(0.0, 1e12));
  }
};

/// The recording that a verb works on, with the axis where it has several and the layout where it
/// has other names or units than the program's.
struct RecordingOption {
  std::string file;
  std::string axis;
  std::string columns, units;

  void add_to(CLI::App* verb) {
    verb->add_option("recording", file, "CSV, CSV.gz or MATLAB file: t_s, gyro_dps, ...")
        ->required();
    verb->add_option("--axis", axis, "x, y or z where the recording has three axes")
        ->check(CLI::Validator(
            [](const std::string& text) {
              return text == "x" || text == "y" || text == "z"
                         ? std::string{}
                         : "'" + text + "' is no axis; allowed: x, y or z";
            },
            "x|y|z"));
    verb->add_option("--columns", columns,
                     "columns of other names, as t=Time[ms],gyro=GyrZ,temp=Temp")
        ->type_name("CHANNEL=COLUMN,...");
    verb->add_option("--units", units, "units, as t=ms,gyro=rad/s,temp=F")
        ->type_name("CHANNEL=UNIT,...");
  }

  RecordingLayout layout() const {
    return {parse_assignments(columns, "--columns"), parse_assignments(units, "--units"),
            layout_place()};
  }

  /// All of it; says in `log` which columns were taken as what, and which mean nothing to gyrostat.
  Recording read_all(std::ostream& log) const {
    auto recording = read_recording(file, axis, layout());
    if (!recording.taken_as.empty())
      log << fmt::format("{}: {}\n", file, fmt::join(recording.taken_as, ", "));
    if (!recording.ignored_columns.empty())
      log << fmt::format("{}: columns not used: {}\n", file,
                         fmt::join(recording.ignored_columns, ", "));
    return recording;
  }

  /// The span of it, checked to be evenly sampled.
  Series read(std::ostream& log, const SpanOption& span = {}) const {
    const auto recording = read_all(log);
    Series series = cut(recording.series, span.from_s, span.to_s, file + ": --from, --to");
    const auto& t_s = recording.series.t_s;
    const auto before = std::lower_bound(t_s.begin(), t_s.end(), series.t_s.front()) - t_s.begin();
    const auto first_row =
        recording.first_row == 0 ? 0 : recording.first_row + static_cast<std::size_t>(before);
    require_uniform(series, file, first_row);
    return series;
  }

 private:
  std::string layout_place() const { return columns.empty() ? "--units" : "--columns"; }
};

}  // namespace gyrostat::cli
