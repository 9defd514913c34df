#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/experiments/findings/lens_pictures.hpp>

namespace gyrostat::gap {
namespace {

Picture envelope_picture(const Envelope& envelope, const std::string& id, const std::string& title,
                         const std::string& note, const std::optional<Transient>& once) {
  Picture picture{.id = id,
                  .title = title,
                  .note = note,
                  .x = {.label = "time from the first sample", .unit = "s"},
                  .y = {.label = "rate", .unit = "dps"}};
  if (envelope.t_s.empty()) return picture;
  auto& line = picture.marks.emplace_back(mark_of(Mark::Kind::line, "", "m0"));
  line.x = envelope.t_s;
  line.y = envelope.mean;
  line.y_low = envelope.low;
  line.y_high = envelope.high;
  if (!once) return picture;
  picture.note += " Dashed: what happened once.";
  auto& when = picture.marks.emplace_back(
      mark_of(Mark::Kind::line, fmt::format("once, {:.3g} Hz", once->frequency_hz), "m2"));
  when.dashed = true;
  const double middle_s = 0.5 * (once->from_s + once->to_s);
  when.x = {middle_s, middle_s};
  when.y = {envelope.mean.front(), envelope.mean.front()};
  for (std::size_t i = 0; i < envelope.t_s.size(); ++i) {  // fmin: a stretch may be missing
    when.y[0] = std::fmin(when.y[0], envelope.low[i]);
    when.y[1] = std::fmax(when.y[1], envelope.high[i]);
  }
  return picture;
}

/// Frequencies of the lines among the effects, with what they are called.
std::vector<std::pair<double, std::string>> lines_of(const Diagnosis& d) {
  std::vector<std::pair<double, std::string>> lines;
  for (const auto& effect : d.enriched.effects)
    for (std::size_t f = 0; f < effect.fields().size(); ++f)
      if (effect.fields()[f].name == "frequency_hz" || effect.fields()[f].name == "centre_hz")
        lines.emplace_back(effect.value(f),
                           fmt::format("{}, {:.3g} Hz", effect.id(), effect.value(f)));
  return lines;
}

Picture allan_picture(const Diagnosis& d) {
  const auto band =
      std::find_if(d.bands.begin(), d.bands.end(), [](const Band& b) { return b.lens == "allan"; });
  if (band == d.bands.end()) return {};
  auto picture = lens_picture(*band, "allan");
  picture.title = "Allan deviation of the rate error";
  picture.y.label = "Allan deviation";
  picture.note = "Of the part that was held back. Bands: where 95 % of simulated recordings lie.";
  return picture;
}

Picture spectrum_picture(const Diagnosis& d) {
  const auto& s = d.portrait.spectrum;
  if (s.frequency_hz.empty()) return {};
  Picture picture{.id = "spectrum",
                  .title = "Spectrum of the rate error",
                  .note = "Root of the mean power density.",
                  .x = {.label = "frequency", .unit = "Hz", .logarithmic = true},
                  .y = {.label = "noise density", .unit = "dps/√Hz", .logarithmic = true}};
  const auto add = [&](const std::string& name, const std::string& colour,
                       const std::vector<double>& density) {
    auto& line = picture.marks.emplace_back(mark_of(Mark::Kind::line, name, colour));
    line.x = s.frequency_hz;
    line.y = density;
  };
  add("recording", "ink", s.recording);
  add(as_it_stands, "m1", s.before);
  add(with_the_effects, "m0", s.after);
  const auto [low, high] = std::minmax_element(s.recording.begin(), s.recording.end());
  const auto lines = lines_of(d);
  if (!lines.empty()) picture.note += " Dashed: the lines that were found.";
  for (const auto& [frequency_hz, name] : lines) {
    auto& line = picture.marks.emplace_back(mark_of(Mark::Kind::line, name, "m2"));
    line.dashed = true;
    line.x = {frequency_hz, frequency_hz};
    line.y = {*low, *high};
  }
  return picture;
}

const std::map<std::string, std::string>& metric_titles() {
  static const std::map<std::string, std::string> titles = {
      {"innovation_std", "Spread of the filter's innovations"},
      {"nis", "Innovations against what the filter expects of them (1: as expected)"},
      {"compensated_allan_deviation_1s", "Noise of the compensated rate at 1 s"},
      {"heading_drift_against_compass", "Drift of the heading against the compass"}};
  return titles;
}

std::string title_of_metric(const std::string& metric) {
  const auto known = metric_titles().find(metric);
  return known == metric_titles().end() ? metric : known->second;
}

}  // namespace

Picture waterfall_picture(const Diagnosis& d) {
  if (d.enrichments.size() < 2 || !(d.gap_before > 0.0)) return {};
  Picture picture{.id = "steps",
                  .title = "From the gap to what is left of it",
                  .note =
                      "What each effect closes beside those above it, on the part of the "
                      "recording that was held back.",
                  .x = {.label = "share of the gap", .unit = "%"}};
  const auto row = [&](const std::string& name, const std::string& colour, double from, double to,
                       const std::string& label) {
    auto& bar = picture.marks.emplace_back(mark_of(Mark::Kind::bars, "", colour));
    bar.labelled = true;
    bar.x = {to};
    bar.y = {static_cast<double>(picture.y.names.size())};
    bar.from = {from};
    bar.labels = {label};
    picture.y.names.push_back(name);
  };
  const auto share = [&](double gap) { return 100.0 * gap / d.gap_before; };
  row(as_it_stands, "none", 0.0, 100.0, "100 %");
  for (std::size_t k = 1; k < d.enrichments.size(); ++k) {
    const double from = share(d.enrichments[k - 1].gap), to = share(d.enrichments[k].gap);
    row("with " + d.enrichments[k].added, to <= from ? "m2" : "m1", from, to,
        fmt::format("{:+.0f} %", to - from));
  }
  row("left", "m0", 0.0, share(d.gap_after), fmt::format("{:.0f} %", share(d.gap_after)));
  return picture;
}

std::vector<Picture> recording_pictures(const Diagnosis& d) {
  return {
      envelope_picture(d.portrait.recorded, "recording", "The recording",
                       "Line: mean; band: from the least to the largest value.", d.transient),
      envelope_picture(d.portrait.left, "residual", "What motion, drift and effects leave of it",
                       "The same, less all that would be alike in every recording: what is "
                       "left is noise, or not understood.",
                       d.transient)};
}

std::vector<Picture> noise_pictures(const Diagnosis& d) {
  std::vector<Picture> pictures;
  for (auto& picture : {allan_picture(d), spectrum_picture(d)})
    if (!picture.marks.empty()) pictures.push_back(picture);
  return pictures;
}

std::vector<Picture> filter_pictures(const Diagnosis& d) {
  std::vector<Picture> pictures;
  for (const auto& t : d.transfer) {
    const auto id = "filters-" + t.metric;
    if (std::any_of(pictures.begin(), pictures.end(), [&](const auto& p) { return p.id == id; }))
      continue;
    Picture picture{
        .id = id,
        .title = title_of_metric(t.metric),
        .x = {.label = t.metric, .unit = t.unit == "1" ? "" : t.unit, .logarithmic = true}};
    auto before = mark_of(Mark::Kind::points, as_it_stands, "m1");
    auto after = mark_of(Mark::Kind::points, with_the_effects, "m0");
    auto real = mark_of(Mark::Kind::points, "recording", "ink");
    after.labelled = true;
    for (const auto& u : d.transfer) {
      if (u.metric != t.metric || !(u.real > 0.0)) continue;
      const auto y = static_cast<double>(picture.y.names.size());
      for (const auto& [mark, x] :
           {std::pair{&before, u.before}, {&after, u.after}, {&real, u.real}}) {
        mark->x.push_back(x > 0.0 ? x : no_value);
        mark->y.push_back(y);
      }
      after.labels.emplace_back(u.moved == Moved::away ? "away" : "");
      picture.y.names.push_back(u.filter);
    }
    if (d.enrichments.size() < 2) after = {};
    for (auto& mark : {before, after, real})
      if (!mark.x.empty()) picture.marks.push_back(mark);
    if (!picture.marks.empty()) pictures.push_back(std::move(picture));
  }
  return pictures;
}

std::vector<Picture> diagnosis_pictures(const Diagnosis& d) {
  std::vector<Picture> pictures = {waterfall_picture(d)};
  for (const auto& some : {recording_pictures(d), noise_pictures(d), filter_pictures(d)})
    pictures.insert(pictures.end(), some.begin(), some.end());
  for (auto& lens : lens_pictures(d)) pictures.push_back(std::move(lens.picture));
  std::erase_if(pictures, [](const Picture& p) { return p.marks.empty(); });
  return pictures;
}

}  // namespace gyrostat::gap
