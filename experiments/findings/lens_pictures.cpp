#include <gyrostat/experiments/findings/lens_pictures.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <gyrostat/diagnosis/physical.hpp>

namespace gyrostat::gap {
namespace {

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

}  // namespace

Mark mark_of(Mark::Kind kind, const std::string& name, const std::string& colour) {
  Mark mark;
  mark.kind = kind;
  mark.name = name;
  mark.colour = colour;
  return mark;
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
  add_simulated(picture, as_it_stands, "m1", x, band.before, band.before_spread, value);
  add_simulated(picture, with_the_effects, "m0", x, band.after, band.after_spread, value);
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

}  // namespace gyrostat::gap
