#include <gyrostat/experiments/findings/diagnosis_page.hpp>

#include <fmt/format.h>

#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>
#include <gyrostat/experiments/findings/lens_pictures.hpp>
#include <gyrostat/experiments/findings/lens_sections.hpp>
#include <gyrostat/experiments/findings/report/live_page.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat::gap {
namespace {

std::string head(const Diagnosis& d, const std::string& name) {
  std::string out =
      fmt::format("<h1>{}</h1>\n<p class=\"answer\">{}</p>\n", escaped(name), escaped(answer(d)));
  for (const auto& more : {in_words(d.line_sources), transient_in_words(d), remainder_in_words(d),
                           transfer_in_words(d), next_in_words(d)})
    if (!more.empty()) out += fmt::format("<p>{}</p>\n", escaped(more));
  return out + fmt::format(
                   "<p class=\"note\">{:.0f} s at {:.4g} Hz, {} samples. What is said to be off or "
                   "mended is of the part that was fitted, its pictures are of the part that was "
                   "held back.</p>\n<p class=\"note "
                   "hint\" hidden>Pictures: drag to zoom, double-click to see all; point at a dot "
                   "for its numbers.</p>\n",
                   d.duration_s, d.rate_hz, d.samples);
}

Table effects_table(const Diagnosis& d) {
  Table table{.title = "What the simulator lacks",
              .columns = {{"effect", ""}, {"", ""}, {"fitted to this recording", ""}}};
  for (const auto& found : d.effects)
    for (const auto& effect : found.parameters)
      table.rows.push_back({found.effect,
                            std::string(effect_types().named(found.effect, "effects").title),
                            parameters_in_words(effect)});
  return table;
}

}  // namespace

std::string diagnosis_page(const Diagnosis& d, const std::string& name) {
  std::string page;
  if (!d.effects.empty()) page += html(effects_table(d));
  page += grid_of({waterfall_picture(d)});
  page += section("The recording", "In the units that it was recorded in.",
                  grid_of(recording_pictures(d)));
  page += section("Noise", "What an ideal sensor would not show.", grid_of(noise_pictures(d)));
  page += section("What it means for the filters",
                  "The same filters with the same parameters on the recording and on simulated "
                  "ones. Blue nearer to black than orange is: a study with the effects promises "
                  "what the sensor keeps.",
                  grid_of(filter_pictures(d)));
  page += lens_sections(lens_pictures(d), "the effects");
  std::string numbers;
  for (const auto& table : diagnosis_tables(d, name)) numbers += html(table);
  page += section("How sure that is", evidence_in_words(d), numbers);
  return live_page(name, head(d, name), page);
}

}  // namespace gyrostat::gap
