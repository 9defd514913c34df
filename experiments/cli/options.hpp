#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "experiments/recording.hpp"
#include "results/render/render.hpp"

namespace gyrostat::cli {

/// `--format`, which every verb that prints tables has.
struct FormatOption {
  std::string name = "text";

  void add_to(CLI::App* verb) {
    verb->add_option("--format", name, "text, md, csv, json or latex")->capture_default_str();
  }
  Format get() const { return format_named(name); }
};

/// The recording that a verb works on, with the axis where it has several.
struct RecordingOption {
  std::string file;
  std::string axis;

  void add_to(CLI::App* verb) {
    verb->add_option("recording", file, "CSV or CSV.gz with a header: t_s, gyro_dps, ...")->required();
    verb->add_option("--axis", axis, "x, y or z where the recording has three axes");
  }

  /// Read, checked to be evenly sampled; says in `log` which columns mean nothing to gyrostat.
  Series read(std::ostream& log) const {
    auto recording = read_recording(file, axis);
    require_uniform(recording.series, file);
    if (!recording.ignored_columns.empty())
      log << fmt::format("{}: columns not used: {}\n", file,
                         fmt::join(recording.ignored_columns, ", "));
    return std::move(recording.series);
  }
};

}  // namespace gyrostat::cli
