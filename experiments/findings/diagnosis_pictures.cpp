#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/physical.hpp>

namespace gyrostat::gap {
namespace {

constexpr const char* before_name = "simulator as it stands";
constexpr const char* after_name = "simulator with the effects";

/// What coordinates of lenses are called on an axis, and their units.
PictureAxis axis_of(const std::string& coordinate) {
  static const std::map<std::string, std::pair<const char*, const char*>> names = {
      {"tau_s", {"averaging time τ", "s"}},
      {"frequency_hz", {"frequency", "Hz"}},
      {"temperature_C", {"temperature", "°C"}},
      {"time_s", {"time", "s"}},
      {"rate_dps", {"rate", "dps"}},
      {"heading_deg", {"heading", "deg"}},
      {"amplitude_dps", {"size", "standard deviations"}},
      {"lag_s", {"lag", "s"}}};
  const auto known = names.find(coordinate);
  return known == names.end()
             ? PictureAxis{.label = coordinate}
             : PictureAxis{.label = known->second.first, .unit = known->second.second};
}

Mark mark_of(Mark::Kind kind, const std::string& name, const std::string& colour) {
  Mark mark;
  mark.kind = kind;
  mark.name = name;
  mark.colour = colour;
  return mark;
}

/// Where each stretch of the coordinate begins that goes one way, as heating and then cooling.
std::vector<std::size_t> branches(const std::vector<double>& at) {
  std::vector<std::size_t> begins = {0};
  double way = 0.0;
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double step = at[i] - at[i - 1];
    if (step * way < 0.0) {
      begins.push_back(i);
      way = 0.0;
    } else {
      way = step;
    }
  }
  return begins;
}

/// A simulator's mean with the band of ± 2 spreads, a line for each branch.
void add_simulated(Picture& picture, const std::string& name, const std::string& colour,
                   const std::vector<double>& x, const std::vector<double>& mean,
                   const std::vector<double>& spread, const Physical& value) {
  const auto begins = branches(x);
  for (std::size_t b = 0; b < begins.size(); ++b) {
    auto& line = picture.marks.emplace_back(mark_of(Mark::Kind::line, name, colour));
    const std::size_t end = b + 1 < begins.size() ? begins[b + 1] : x.size();
    for (std::size_t i = begins[b]; i < end; ++i) {
      line.x.push_back(x[i]);
      line.y.push_back(value(mean[i]));
      line.y_low.push_back(value(mean[i] - 2.0 * spread[i]));
      line.y_high.push_back(value(mean[i] + 2.0 * spread[i]));
    }
  }
}

/// What a lens shows, as it is drawn: the root of a variance is a deviation.
std::string title_of(const Band& band, const Physical& value) {
  std::string title = band.title;
  const auto instead = [&](const std::string& of, const std::string& word) {
    if (const auto at = title.find(of); at != std::string::npos) title.replace(at, of.size(), word);
  };
  if (value.root) {
    instead("variance", "deviation");
    instead("power spectral density", "noise density");
  }
  if (!title.empty())
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

Picture lens_picture(const Band& band, const std::string& id) {
  const Physical value(band.unit);
  Picture picture{.id = id,
                  .title = title_of(band, value),
                  .x = axis_of(band.coordinate),
                  .y = {.label = value.is_logarithmic && value.unit == "1" ? "ratio" : "reading",
                        .unit = value.unit,
                        .logarithmic = value.is_logarithmic}};
  std::vector<double> x = band.at;
  if (x.size() > 1 && x.front() == x.back()) {  // readings of the whole, not along anything
    picture.x = {.label = "reading"};
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = static_cast<double>(i);
      picture.x.names.push_back(std::to_string(i + 1));
    }
  } else {
    picture.x.logarithmic = (band.coordinate == "tau_s" || band.coordinate == "frequency_hz") &&
                            x.size() > 1 && *std::min_element(x.begin(), x.end()) > 0.0;
  }
  add_simulated(picture, before_name, "m1", x, band.before, band.before_spread, value);
  add_simulated(picture, after_name, "m0", x, band.after, band.after_spread, value);
  auto& recording = picture.marks.emplace_back(mark_of(Mark::Kind::points, "recording", "ink"));
  recording.x = std::move(x);
  for (std::size_t i = 0; i < band.at.size(); ++i) {
    recording.y.push_back(value(band.observed[i]));
    recording.labels.push_back(
        fmt::format("{:.4g} {}: recording {:.4g}, as it stands {:.4g}, with the effects {:.4g} {}",
                    band.at[i], axis_of(band.coordinate).unit, value(band.observed[i]),
                    value(band.before[i]), value(band.after[i]), value.unit));
  }
  return picture;
}

const Where* clearest_of(const std::vector<Where>& departures, const std::string& lens) {
  const Where* found = nullptr;
  for (const auto& w : departures)
    if (w.lens == lens && (found == nullptr || w.p_adjusted < found->p_adjusted)) found = &w;
  return found;
}

/// Whether the held-out part, which a lens's picture is of, is off the simulator with the effects.
bool is_off_where_held_back(const Band& band) {
  constexpr double far = 5.0;  // spreads: of some hundred readings, none by chance
  for (std::size_t i = 0; i < band.after.size(); ++i)
    if (std::abs(band.observed[i] - band.after[i]) > far * band.after_spread[i]) return true;
  return false;
}

/// "at τ = 0.02 s the recording has 0.15 dps, the simulator 0.18 dps".
std::string told(const Where& w) {
  const Physical value(w.unit);
  const auto axis = axis_of(w.coordinate);
  const auto unit = value.unit == "1" ? "" : ' ' + value.unit;
  const auto place =
      w.from == 0.0 && w.to == 0.0 ? ""
      : w.from == w.to
          ? fmt::format("at {} = {:.3g} {} ", axis.label, w.from, axis.unit)
          : fmt::format("at {} {:.3g} to {:.3g} {} ", axis.label, w.from, w.to, axis.unit);
  return fmt::format("{}the recording has {:.3g}{}, the simulator {:.3g}{}", place,
                     value(w.observed), unit, value(w.simulated), unit);
}

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
  when.y = {*std::min_element(envelope.low.begin(), envelope.low.end()),
            *std::max_element(envelope.high.begin(), envelope.high.end())};
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
  add(before_name, "m1", s.before);
  add(after_name, "m0", s.after);
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
  row(before_name, "none", 0.0, 100.0, "100 %");
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
    auto before = mark_of(Mark::Kind::points, before_name, "m1");
    auto after = mark_of(Mark::Kind::points, after_name, "m0");
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

std::vector<LensPicture> lens_pictures(const Diagnosis& d) {
  std::vector<LensPicture> all;
  for (const auto& band : d.bands) {
    const auto* before = clearest_of(d.where, band.lens);
    const auto* after = clearest_of(d.where_after, band.lens);
    auto picture = lens_picture(band, "lens-" + band.lens);
    const bool is_mended_in_part =
        after == nullptr && before != nullptr && is_off_where_held_back(band);
    const auto agreement = after != nullptr || is_mended_in_part ? Agreement::still_off
                           : before != nullptr                   ? Agreement::mended
                                                                 : Agreement::always;
    if (agreement != Agreement::always)
      picture.title = (agreement == Agreement::mended ? "✓ " : "✗ ") + picture.title;
    if (after != nullptr)
      picture.note = fmt::format("Still off: {}.", told(*after));
    else if (is_mended_in_part)
      picture.note = fmt::format(
          "Still off where it was held back. Mended where it was fitted: "
          "without the effects {}.",
          told(*before));
    else if (before != nullptr)
      picture.note = fmt::format("Mended: without the effects {}.", told(*before));
    const auto* decisive = after != nullptr ? after : before;
    all.push_back(
        {std::move(picture), agreement, decisive == nullptr ? 1.0 : decisive->p_adjusted});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::pair(a.agreement, a.p) < std::pair(b.agreement, b.p);
  });
  return all;
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
