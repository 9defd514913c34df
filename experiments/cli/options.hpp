#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/cli/span_option.hpp>
#include <gyrostat/experiments/study/json.hpp>
#include <gyrostat/recordings/clock.hpp>
#include <gyrostat/recordings/format_type.hpp>
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

/// A check of an option's value, which is a finite number of this unit.
inline CLI::Validator within(double low, double high, const std::string& unit = "") {
  return {[range = Range{.from = low, .to = high}, unit](const std::string& text) {
            double value = 0.0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            return is_number && range.contains(value)
                       ? std::string{}
                       : fmt::format("'{}' is {}; allowed: {}", text,
                                     is_number ? "out of range" : "no number",
                                     values_in_words(range, unit));
          },
          "NUMBER"};
}

/// A check of an option's value, which is a whole number.
inline CLI::Validator whole(std::uint64_t low, std::uint64_t high) {
  const auto allowed = fmt::format("{} to {}", low, high);
  return {[low, high, allowed](const std::string& text) {
            std::uint64_t value = 0;
            const bool is_whole = CLI::detail::lexical_cast(text, value);
            return is_whole && value >= low && value <= high
                       ? std::string{}
                       : fmt::format("'{}' is {}; allowed: {}", text,
                                     is_whole ? "out of range" : "no whole number",
                                     "whole numbers from " + allowed);
          },
          allowed};
}
inline constexpr std::uint64_t most_trials = 4294967295;  ///< of a cell
inline constexpr std::uint64_t largest_seed = std::uint64_t{1} << 53;

/// The recording that a verb works on, with the axis where it has several, and what the program
/// cannot tell from the file: its format, names, units, rate.
struct RecordingOption {
  std::string file;
  std::string axis;
  std::string columns, units, preset, topic;
  double rate_hz = 0.0, resample_hz = 0.0;

  void add_to(CLI::App* verb) {
    verb->add_option(
            "recording", file,
            "CSV, CSV.gz, or a log in any format of `gyrostat list formats`; - is standard "
            "input")
        ->required();
    verb->add_option(
            "--axis", axis,
            "x, y or z where the recording has three axes; diagnose: all unless one is chosen")
        ->check(CLI::Validator(
            [](const std::string& text) {
              return text == "x" || text == "y" || text == "z" || text == "all"
                         ? std::string{}
                         : "'" + text + "' is no axis; allowed: x, y or z; diagnose: or all";
            },
            "x|y|z|all"));
    verb->add_option("--columns", columns,
                     "columns of other names, as t=Time[ms],gyro=GyrZ,temp=Temp, or by number, as "
                     "1=t,4=gyro")
        ->type_name("CHANNEL=COLUMN,...");
    verb->add_option("--units", units, "units, as t=ms,gyro=rad/s,temp=F or gyro=lsb/131")
        ->type_name("CHANNEL=UNIT,...");
    verb->add_option("--preset", preset,
                     "the format, of `gyrostat list formats`, where the content does not tell it")
        ->type_name("NAME");
    verb->add_option("--topic", topic, "of a log that has several gyros")->type_name("NAME");
    verb->add_option("--rate", rate_hz, "samples a second, for a file without times")
        ->type_name("HZ")
        ->check(within(1e-6, 1e7, "Hz"));
    verb->add_option("--resample", resample_hz,
                     "put the samples on an even clock, where their rate changes")
        ->type_name("HZ")
        ->check(within(1e-6, 1e7, "Hz"));
  }

  RecordingLayout layout() const {
    return {.columns = parse_assignments(columns, "--columns"),
            .units = parse_assignments(units, "--units"),
            .place = preset.empty() && columns.empty() ? "--units"
                     : columns.empty()                 ? "--preset"
                                                       : "--columns",
            .preset = preset,
            .topic = topic,
            .rate_hz = rate_hz,
            .resample_hz = resample_hz};
  }

  /// As a study in `folder` names it.
  Json source_for(const std::filesystem::path& folder) const {
    namespace fs = std::filesystem;
    const auto from_root = [](const fs::path& path) {
      return (fs::current_path() / path).lexically_normal();
    };
    Json source = {{"file", from_root(file).lexically_proximate(from_root(folder)).string()}};
    const auto how = layout();
    if (!axis.empty()) source["axis"] = axis;
    if (!how.columns.empty()) source["columns"] = how.columns;
    if (!how.units.empty()) source["units"] = how.units;
    if (!preset.empty()) source["preset"] = preset;
    if (!topic.empty()) source["topic"] = topic;
    if (rate_hz > 0.0) source["rate_hz"] = rate_hz;
    if (resample_hz > 0.0) source["resample_hz"] = resample_hz;
    return source;
  }

  /// All of it, evenly sampled; says in `log` as what it was read and what was done to it. `wanted`
  /// as `read_recording` has it.
  Recording read_all(std::ostream& log, std::span<const std::string_view> wanted = {}) const {
    const auto how = layout();
    auto recording = read_recording(file, axis, how, wanted);
    make_even(recording, file, how);
    if (!recording.format.empty())
      log << fmt::format("{}: {} (--preset {})\n", file,
                         format_types().named(recording.format, file).title, recording.format);
    if (!recording.taken_as.empty())
      log << fmt::format("{}: {}\n", file, fmt::join(recording.taken_as, ", "));
    if (!recording.ignored_columns.empty())
      log << fmt::format("{}: columns not used: {}\n", file,
                         fmt::join(recording.ignored_columns, ", "));
    if (!recording.notes.empty())
      log << fmt::format("{}: {}\n", file, fmt::join(recording.notes, "; "));
    return recording;
  }

  /// From the first sample that is there to the last, both of them included.
  static Series between_samples(const Series& series) {
    const auto& z = series.gyro_dps;
    const auto is_there = [](double value) { return value == value; };
    const auto first = std::find_if(z.begin(), z.end(), is_there);
    const auto last = std::find_if(z.rbegin(), z.rend(), is_there);
    if (first == z.end()) return series;
    return series.slice(static_cast<std::size_t>(first - z.begin()),
                        static_cast<std::size_t>(last.base() - first));
  }

  /// Throws InputError, naming the nearest samples, where the recording pauses all over the span.
  static void require_samples(const Series& series, const SpanOption& span,
                              const std::string& file) {
    double before = -1.0, after = -1.0;
    for (std::size_t i = 0; i < series.size() && after < 0.0; ++i) {
      if (series.gyro_dps[i] != series.gyro_dps[i]) continue;
      const double at = series.t_s[i] - series.t_s.front();
      if (at >= span.from_s && at < span.to_s) return;
      (at < span.from_s ? before : after) = at;
    }
    throw InputError(
        file + ": --from, --to",
        fmt::format("the recording pauses between {:g} and {:g} s{}{}", span.from_s, span.to_s,
                    before < 0.0 ? "" : fmt::format("; it was there to {:.6g} s", before),
                    after < 0.0 ? "" : fmt::format("; it is there from {:.6g} s", after)));
  }

  /// Short bursts with long pauses, which only an Allan deviation is told by.
  enum class Bursts { refused, taken };

  /// The span of it, and where that begins, s from the first sample of all.
  struct Read {
    Series series;
    double begins_s = 0.0;
  };
  Read read_span(std::ostream& log, const SpanOption& span = {},
                 std::span<const std::string_view> wanted = {},
                 Bursts bursts = Bursts::refused) const {
    auto whole = read_all(log, wanted).series;
    span.leave_out(whole, file);
    if (!span.is_part_of(whole)) {
      if (bursts == Bursts::refused) require_dense(whole, file);
      return {std::move(whole)};
    }
    Read read{cut(whole, span.from_s, span.to_s, file + ": --from, --to")};
    require_samples(whole, span, file);
    read.series = between_samples(read.series);
    read.begins_s = read.series.t_s.front() - whole.t_s.front();
    if (bursts == Bursts::refused) require_dense(read.series, file, read.begins_s);
    return read;
  }
  Series read(std::ostream& log, const SpanOption& span = {},
              std::span<const std::string_view> wanted = {},
              Bursts bursts = Bursts::refused) const {
    return read_span(log, span, wanted, bursts).series;
  }
};

}  // namespace gyrostat::cli
