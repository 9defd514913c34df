#include <gyrostat/experiments/findings/diagnosis_page.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/experiments/findings/report/live_page.hpp>
#include <gyrostat/results/pictures/picture.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat::gap {
namespace {

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
                   const std::vector<double>& spread) {
  const auto begins = branches(x);
  for (std::size_t b = 0; b < begins.size(); ++b) {
    auto& line = picture.marks.emplace_back();
    line.name = name;
    line.colour = colour;
    const std::size_t end = b + 1 < begins.size() ? begins[b + 1] : x.size();
    for (std::size_t i = begins[b]; i < end; ++i) {
      line.x.push_back(x[i]);
      line.y.push_back(mean[i]);
      line.y_low.push_back(mean[i] - 2.0 * spread[i]);
      line.y_high.push_back(mean[i] + 2.0 * spread[i]);
    }
  }
}

Picture readings(const Band& band, std::size_t number) {
  Picture picture{.id = fmt::format("lens-{}", number),
                  .title = band.title,
                  .x = {.label = band.coordinate},
                  .y = {.label = band.channel, .unit = band.unit}};
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
  add_simulated(picture, "simulator before", "m1", x, band.before, band.before_spread);
  add_simulated(picture, "simulator after", "m0", x, band.after, band.after_spread);
  auto& recording = picture.marks.emplace_back();
  recording.kind = Mark::Kind::points;
  recording.name = "recording";
  recording.colour = "ink";
  recording.x = std::move(x);
  recording.y = band.observed;
  for (std::size_t i = 0; i < band.at.size(); ++i)
    recording.labels.push_back(
        fmt::format("{:.4g} {}: recording {:.5g}, simulated before {:.5g} ± {:.2g}, after {:.5g} "
                    "± {:.2g} {}",
                    band.at[i], band.coordinate, band.observed[i], band.before[i],
                    band.before_spread[i], band.after[i], band.after_spread[i], band.unit));
  return picture;
}

Picture bars(const std::string& id, const std::string& title, const std::string& what,
             const std::string& unit, const std::vector<std::pair<std::string, double>>& values) {
  Picture picture{.id = id, .title = title, .x = {.label = what, .unit = unit}};
  Mark mark;
  mark.kind = Mark::Kind::bars;
  mark.colour = "m0";
  mark.labelled = true;
  for (const auto& [name, value] : values) {
    mark.x.push_back(value);
    mark.y.push_back(static_cast<double>(picture.y.names.size()));
    mark.labels.push_back(fmt::format("{:.3g}", value));
    picture.y.names.push_back(name);
  }
  picture.marks = {std::move(mark)};
  return picture;
}

}  // namespace

std::string diagnosis_page(const Diagnosis& d, const std::string& name) {
  std::vector<std::pair<std::string, double>> probabilities, steps;
  for (const auto& c : d.causes) probabilities.emplace_back(c.effect, c.probability);
  for (const auto& e : d.enrichments)
    steps.emplace_back(e.added.empty() ? "(baseline)" : e.added, e.gap);
  std::string page = "<div class=\"pictures\">\n";
  if (!probabilities.empty())
    page += html(bars("causes", "Probability of each cause", "probability", "", probabilities));
  page += html(bars("steps", "Gap on the held-out part", "gap", "spreads", steps)) + "</div>\n";
  page +=
      "<h2>Held-out readings of each lens</h2><p class=\"note\">Points: the recording; lines with "
      "bands: the simulator before and after, ± 2 spreads.</p>\n<div class=\"pictures\">\n";
  for (std::size_t b = 0; b < d.bands.size(); ++b) page += html(readings(d.bands[b], b));
  page += "</div>\n";
  for (const auto& table : diagnosis_tables(d, name)) page += html(table);
  return live_page(
      name,
      fmt::format("<h1>{}</h1>\n<p>{}</p>\n<p class=\"note hint\" hidden>Pictures: drag to zoom, "
                  "double-click to see all; point at a dot for its numbers.</p>\n",
                  escaped(name), escaped(in_words(d, name))),
      page);
}

}  // namespace gyrostat::gap
