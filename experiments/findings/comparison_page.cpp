#include <gyrostat/experiments/findings/comparison_page.hpp>

#include <fmt/format.h>

#include <gyrostat/diagnosis/compare/comparison_text.hpp>
#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>
#include <gyrostat/experiments/findings/lens_sections.hpp>
#include <gyrostat/experiments/findings/report/live_page.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat::gap {
namespace {

/// What the pictures of a diagnosis show, of segments: the recordings' and the simulator's, before
/// and after what it lacks is added.
Diagnosis as_diagnosis(const Comparison& c) {
  Diagnosis d;
  d.where = c.where;
  d.where_after = c.where_after;
  d.bands = c.bands;
  d.enrichments = c.enrichments;
  d.gap_before = c.gap_before;
  d.gap_after = c.gap_after;
  return d;
}

/// Each paragraph of the answer.
std::string head(const std::string& title, const std::string& words) {
  std::string out = fmt::format("<h1>{}</h1>\n", escaped(title));
  const char* kind = "answer";
  for (std::size_t at = 0; at < words.size();) {
    const auto end = std::min(words.find("\n\n", at), words.size());
    out += fmt::format("<p class=\"{}\">{}</p>\n", kind, escaped(words.substr(at, end - at)));
    kind = "note";
    at = end + 2;
  }
  return out +
         "<p class=\"note hint\" hidden>Pictures: drag to zoom, double-click to see all; point at "
         "a dot for its numbers.</p>\n";
}

}  // namespace

std::string comparison_page(const Comparison& c, const std::string& recordings,
                            const std::string& simulated) {
  const auto view = as_diagnosis(c);
  std::string page = grid_of({waterfall_picture(view)});
  page += lens_sections(lens_pictures(view), "what was added");
  std::string numbers;
  for (const auto& table : comparison_tables(c)) numbers += html(table);
  page += section("How sure that is",
                  fmt::format("Means over {} segments of the recordings and {} of the simulator, "
                              "{:.4g} s each; bands: ± 2 spreads of a simulated segment.",
                              c.segments_real, c.segments_simulated, c.segment_s),
                  numbers);
  const auto title = simulated + " against " + recordings;
  return live_page(title, head(title, in_words(c, recordings, simulated)), page);
}

}  // namespace gyrostat::gap
