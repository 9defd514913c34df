#include <gyrostat/experiments/findings/diagnosis_page.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat::gap {
namespace {

constexpr double width = 460.0, height = 230.0, left = 64.0, bottom = 34.0, top = 10.0,
                 right = 10.0;

/// A scale from values to pixels.
struct Axis {
  double low, high, from, to;
  bool logarithmic;
  double operator()(double v) const {
    const double x = logarithmic ? std::log10(v) : v;
    return from + (x - low) / std::max(high - low, 1e-300) * (to - from);
  }
};

std::string picture(const Band& band) {
  const std::size_t n = band.at.size();
  const bool branches = !std::is_sorted(band.at.begin(), band.at.end());
  const bool logarithmic = band.coordinate == "tau_s" || band.coordinate == "frequency_hz";
  std::vector<double> x(band.at);
  if (branches || (n > 1 && band.at.front() == band.at.back()))
    for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<double>(i);
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < n; ++i)
    for (const double v : {band.observed[i], band.before[i] + 2 * band.before_spread[i],
                           band.before[i] - 2 * band.before_spread[i], band.after[i]}) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  const bool log_x = logarithmic && !branches && x.front() > 0.0 && n > 1;
  const auto scaled = [&](double v) { return log_x ? std::log10(v) : v; };
  const Axis across{n > 1 ? scaled(x.front()) : x.front() - 1.0,
                    n > 1 ? scaled(x.back()) : x.front() + 1.0, left, width - right, log_x};
  const Axis up{low, high, height - bottom, top, false};
  const auto ribbon = [&](const std::vector<double>& mean, const std::vector<double>& spread,
                          const char* style) {
    std::string points;
    for (std::size_t i = 0; i < n; ++i)
      points += fmt::format("{:.1f},{:.1f} ", across(x[i]), up(mean[i] + 2 * spread[i]));
    for (std::size_t i = n; i-- > 0;)
      points += fmt::format("{:.1f},{:.1f} ", across(x[i]), up(mean[i] - 2 * spread[i]));
    return fmt::format("<polygon class=\"{}\" points=\"{}\"/>", style, points);
  };
  std::string svg =
      fmt::format("<figure><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", width,
                  height, escaped(band.title));
  svg += ribbon(band.before, band.before_spread, "before") +
         ribbon(band.after, band.after_spread, "after");
  for (std::size_t i = 0; i < n; ++i)
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.4\"><title>{:.4g} {}: recording {:.5g}, "
        "simulated "
        "before {:.5g} ± {:.2g}, after {:.5g} ± {:.2g} {}</title></circle>",
        across(x[i]), up(band.observed[i]), band.at[i], band.coordinate, band.observed[i],
        band.before[i], band.before_spread[i], band.after[i], band.after_spread[i],
        escaped(band.unit));
  svg += fmt::format(
      "<line x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\"/><line x1=\"{0}\" y1=\"{1}\" x2=\"{0}\" "
      "y2=\"{3}\"/>",
      left, height - bottom, width - right, top);
  svg += fmt::format(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.3g}</text><text x=\"{}\" y=\"{}\" "
      "text-anchor=\"end\">{:.3g}</text>",
      left - 4, height - bottom, low, left - 4, top + 10, high);
  svg += fmt::format(
      "<text x=\"{}\" y=\"{}\">{:.3g}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.3g} "
      "{}</text>",
      left, height - bottom + 16, band.at.front(), width - right, height - bottom + 16,
      band.at.back(), band.coordinate);
  return svg + fmt::format("</svg><figcaption>{} [{}]</figcaption></figure>\n", escaped(band.title),
                           escaped(band.unit));
}

std::string bars(const std::string& title,
                 const std::vector<std::pair<std::string, double>>& values) {
  double high = 1e-12;
  for (const auto& [name, v] : values) high = std::max(high, v);
  const double row = 24.0;
  std::string svg =
      fmt::format("<figure><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", width,
                  row * static_cast<double>(values.size()) + 8.0, escaped(title));
  double y = 4.0;
  for (const auto& [name, v] : values) {
    svg += fmt::format(
        "<text x=\"140\" y=\"{}\" text-anchor=\"end\">{}</text><rect x=\"146\" y=\"{}\" "
        "width=\"{:.1f}\" height=\"16\"/>"
        "<text x=\"{:.1f}\" y=\"{}\">{:.3g}</text>",
        y + 13, escaped(name), y, 240.0 * std::max(v, 0.0) / high,
        150.0 + 240.0 * std::max(v, 0.0) / high, y + 13, v);
    y += row;
  }
  return svg + fmt::format("</svg><figcaption>{}</figcaption></figure>\n", escaped(title));
}

constexpr std::string_view style = R"(
.grid{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,20rem),1fr));gap:1rem}
figure{margin:0}svg{width:100%;height:auto}svg text{font-size:11px;fill:currentColor}svg line{stroke:var(--soft)}
.before{fill:var(--m1);opacity:.3}.after{fill:var(--m0);opacity:.4}circle{fill:currentColor}rect{fill:var(--m0)}
.key b{padding:0 .6rem}.key .b{background:color-mix(in srgb,var(--m1) 40%,transparent)}
.key .a{background:color-mix(in srgb,var(--m0) 50%,transparent)}
)";

}  // namespace

std::string diagnosis_page(const Diagnosis& d, const std::string& name) {
  std::string page = fmt::format("<h1>{}</h1><p>{}</p>", escaped(name), escaped(in_words(d, name)));
  std::vector<std::pair<std::string, double>> probabilities, steps;
  for (const auto& c : d.causes) probabilities.emplace_back(c.effect, c.probability);
  for (const auto& e : d.enrichments)
    steps.emplace_back(e.added.empty() ? "(baseline)" : e.added, e.gap);
  page += "<div class=\"grid\">";
  if (!probabilities.empty()) page += bars("probability of each cause", probabilities);
  page += bars("gap on the held-out part, spreads", steps) + "</div>";
  page +=
      "<h2>Held-out readings of each lens</h2><p class=\"key\">points: recording; <b "
      "class=\"b\">simulator before</b> "
      "<b class=\"a\">and after</b>, ± 2 spreads; point at a dot for its numbers</p><div "
      "class=\"grid\">";
  for (const auto& band : d.bands) page += picture(band);
  page += "</div>";
  for (const auto& table : diagnosis_tables(d, name)) page += html(table);
  return html_page(name, style, page);
}

}  // namespace gyrostat::gap
