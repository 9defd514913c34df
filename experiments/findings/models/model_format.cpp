#include <gyrostat/experiments/findings/models/model_format.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/answer.hpp>

namespace gyrostat {
namespace {

std::string coefficient_in_words(const AllanCoefficient& c, double unit, std::string_view name) {
  if (!(c.lower < c.upper)) return fmt::format("{:.4g} {}", unit * c.value, name);
  if (!(c.value > 0.0)) return fmt::format("below {:.4g} {} (95 %)", unit * c.upper, name);
  return fmt::format("{:.4g} {} (95 %: {:.4g} to {:.4g})", unit * c.value, name, unit * c.lower,
                     unit * c.upper);
}

std::string coefficients_in_words(const SensorModel& model) {
  return fmt::format(
      "N = {}; B = {}; K = {}.",
      coefficient_in_words(model.N, angle_random_walk_deg_per_sqrt_h(1.0), "deg/sqrt(h)"),
      coefficient_in_words(model.B, bias_instability_deg_per_h(1.0), "deg/h"),
      coefficient_in_words(model.K, rate_random_walk_deg_per_h_per_sqrt_h(1.0), "deg/h/sqrt(h)"));
}

std::string cover_in_words(const Cover& cover, bool holds_walk) {
  const double up_to = cover.up_to_s;
  if (up_to == 0.0)
    return fmt::format("Inflate N by {:.2g}, because of {}.", cover.factor_of_N, cover.because);
  const auto other = holds_walk && cover.factor_of_K > 1.05 && cover.factor_of_K < 1e3
                         ? fmt::format(" (or K by {:.2g})", cover.factor_of_K)
                         : "";
  return fmt::format("Inflate N by {:.2g} up to {:.3g} s, because of {}{}.", cover.factor_of_N,
                     up_to, cover.because, other);
}

std::vector<std::string> left_out_by(const SensorModel& model, const ModelFormat& format) {
  std::vector<std::string> names;
  for (const auto& effect : model.scenario.effects)
    if (std::find(format.holds.begin(), format.holds.end(), effect.id()) == format.holds.end() &&
        std::find(names.begin(), names.end(), effect.id()) == names.end())
      names.emplace_back(effect.id());
  return names;
}

void say_what_is_left_out(const SensorModel& model, const std::vector<std::string>& left_out,
                          std::vector<std::string>& remarks) {
  if (!model.measured.empty()) {
    remarks.emplace_back(
        "From the Allan deviation alone: what else the sensor has is not known here. `gyrostat "
        "diagnose REC.csv --json GAP.json`, exported, tells what this file cannot hold.");
    return;
  }
  if (left_out.empty()) {
    remarks.emplace_back("It holds every effect of this model.");
  } else {
    std::vector<std::string> said;
    for (const auto& effect : model.scenario.effects)
      if (std::find(left_out.begin(), left_out.end(), effect.id()) != left_out.end())
        said.push_back(fmt::format("{} ({})", effect.id(), gap::parameters_in_words(effect)));
    remarks.push_back(fmt::format("It cannot hold {}.", fmt::join(said, "; ")));
  }
  if (const auto open = left_open(model, left_out); !open.empty()) remarks.push_back(open);
}

}  // namespace

const std::vector<ModelFormat>& model_formats() {
  static const auto all = [] {
    std::vector<ModelFormat> formats;
    append_model_formats(formats);
    return formats;
  }();
  return all;
}

const ModelFormat& model_format_named(const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const auto& format : model_formats()) {
    if (format.id == name) return format;
    names.emplace_back(format.id);
  }
  throw InputError(place, unknown_name("format", name, names));
}

std::string left_open(const SensorModel& model, const std::vector<std::string>& left_out) {
  if (!model.gap || !(model.gap->before > 0.0)) return "";
  const auto& gap = *model.gap;
  const auto is_out = [&](const std::string& effect) {
    return std::find(left_out.begin(), left_out.end(), effect) != left_out.end();
  };
  const auto percent = [&](double open) {
    return std::clamp(100.0 * open / gap.before, 0.0, 100.0);
  };
  const double after = gap.steps.empty() ? gap.before : gap.steps.back().second;
  double open = gap.before;
  std::size_t held = 0;
  while (held < gap.steps.size() && !is_out(gap.steps[held].first)) open = gap.steps[held++].second;
  const auto further =
      std::count_if(gap.steps.begin() + static_cast<std::ptrdiff_t>(held), gap.steps.end(),
                    [&](const auto& s) { return is_out(s.first); });
  if (held == gap.steps.size())
    return fmt::format("That leaves {:.0f} % of the gap open, as the diagnosis does.",
                       percent(after));
  if (held + static_cast<std::size_t>(further) == gap.steps.size())
    return fmt::format(
        "That leaves {:.0f} % of the gap open, of which the diagnosis leaves {:.0f} "
        "itself.",
        percent(open), percent(after));
  double least = 0.0;
  for (const auto& [effect, without] : gap.without)
    if (is_out(effect)) least = std::max(least, without);
  return fmt::format(
      "That leaves {}{:.0f} % of the gap open, of which the diagnosis leaves {:.0f} "
      "itself.",
      left_out.size() > 1 ? "at least " : "", percent(least), percent(after));
}

std::string write_model(const SensorModel& model, const ModelFormat& format,
                        const ModelOptions& options) {
  const auto left_out = left_out_by(model, format);
  const auto needed = covers(model, left_out, options.averaging_s);
  ModelSheet sheet{.model = model,
                   .N = radians * model.N.value,
                   .B = radians * model.B.value,
                   .K = radians * model.K.value,
                   .averaging_s = options.averaging_s,
                   .remarks = {}};
  auto& remarks = sheet.remarks;
  remarks.push_back(fmt::format("{} of a gyro at {:.6g} Hz, written by gyrostat from {}.",
                                format.title, model.rate_hz, model.source));
  remarks.push_back(coefficients_in_words(model));
  remarks.emplace_back("One axis was looked at; all three are given its numbers.");
  say_what_is_left_out(model, left_out, remarks);
  if (!format.holds_walk && model.K.value > 0.0)
    remarks.emplace_back("It has no random walk of the bias.");
  for (const auto& cover : needed) remarks.push_back(cover_in_words(cover, format.holds_walk));
  if (needed.empty() && !left_out.empty())
    remarks.push_back(
        fmt::format("No inflation of N makes up for that: up to {:.3g} s it adds "
                    "nothing to the Allan deviation.",
                    options.averaging_s));
  if (options.inflate && !needed.empty()) {
    sheet.N *= needed.back().factor_of_N;
    remarks.push_back(fmt::format("N below is inflated by {:.4g}, for averaging up to {:.3g} s.",
                                  needed.back().factor_of_N, options.averaging_s));
  }
  return format.write(sheet);
}

std::string commented(std::span<const std::string> lines, std::string_view mark) {
  constexpr std::size_t width = 96;
  std::string text;
  for (const auto& line : lines) {
    std::size_t column = 0;
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t end = std::min(line.find(' ', at), line.size());
      const auto word = line.substr(at, end - at);
      if (column > 0 && column + 1 + word.size() > width) {
        text += '\n';
        column = 0;
      }
      if (column == 0) {
        text += mark;
        column = mark.size();
      }
      text += ' ' + word;
      column += 1 + word.size();
      at = end + 1;
    }
    text += '\n';
  }
  return text;
}

}  // namespace gyrostat
