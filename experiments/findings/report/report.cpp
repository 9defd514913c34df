#include <gyrostat/experiments/findings/report/report.hpp>

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/findings/report/cell_section.hpp>
#include <gyrostat/experiments/findings/report/design_sections.hpp>
#include <gyrostat/experiments/findings/report/live_page.hpp>
#include <gyrostat/experiments/findings/report/picture.hpp>
#include <gyrostat/experiments/findings/report/run_times.hpp>
#include <gyrostat/experiments/findings/sensitivity_words.hpp>
#include <gyrostat/experiments/study/address.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_cells = 6;

/// Cells shown in full: those asked for, or the first few that do not serve a design alone, and of
/// many made from one, as "ramp[phi=0.5]", only the first.
std::vector<std::size_t> chosen_cells(const Study& study, const std::vector<std::string>& names) {
  std::vector<std::size_t> chosen;
  for (const auto& name : names)
    chosen.push_back(
        static_cast<std::size_t>(&cell_named(study, name, "--cell") - study.cells.data()));
  std::set<std::string> families;
  for (std::size_t c = 0; names.empty() && c < study.cells.size() && chosen.size() < most_cells;
       ++c) {
    if (serves_a_design(study, c)) continue;
    const auto& name = study.cells[c].name;
    if (families.insert(name.substr(0, name.find('['))).second) chosen.push_back(c);
  }
  return chosen;
}

std::string head(const Study& study, const Manifest& manifest) {
  std::uint64_t finished = 0;
  for (const auto& cell : manifest.cells) finished += std::min(cell.finished, cell.trials);
  const auto title = study.title.empty() ? study.name() : study.title;
  return fmt::format(
      "<h1>{}</h1>\n<p class=\"note\">Study {}, {}, {} of {} finished; seed {}, "
      "digest <code>{}</code></p>\n<p class=\"note hint\" hidden>Pictures: drag to zoom, "
      "double-click "
      "to see all. By keyboard: arrows go from point to point, + − 0 zoom, Shift and arrows move, "
      "Enter copies the command that replays an outlier.</p>\n",
      escaped(title), escaped(study.name()), counted(study.cells.size(), "cell"), finished,
      counted(study.trials(), "trial"), study.seed, escaped(manifest.digest));
}

/// What matters in each design; the most important sentence of every cell, those shown in full as
/// links.
std::string in_short(const Study& study, const std::vector<CellRanking>& rankings,
                     const std::vector<std::size_t>& chosen,
                     const std::vector<DesignSensitivities>& designs) {
  constexpr std::size_t most = 200;
  std::string out =
                  "<section aria-labelledby=\"short\"><h2 id=\"short\">In short</h2>\n<ul "
                  "class=\"sentences\">\n",
              rest;
  for (std::size_t d = 0; d < designs.size(); ++d)
    if (const auto sentence = sensitivity_sentence(designs[d].front()); !sentence.empty())
      out += fmt::format("<li><b><a href=\"#design-{}\">{}</a></b>: {}</li>\n", d,
                         escaped(designs[d].front().design), escaped(sentence));
  std::size_t others = 0;
  for (std::size_t c = 0; c < study.cells.size(); ++c) {
    const bool full = std::find(chosen.begin(), chosen.end(), c) != chosen.end();
    if (!full && serves_a_design(study, c)) continue;
    if (!full && ++others > most) continue;
    const auto& sentences = rankings[c].sentences;
    const auto name =
        full ? fmt::format("<a href=\"#cell-{}\">{}</a>", c, escaped(study.cells[c].name))
             : escaped(study.cells[c].name);
    (full ? out : rest) +=
        fmt::format("<li><b>{}</b>: {}</li>\n", name,
                    escaped(sentences.empty() ? "no finished trials" : sentences[0]));
  }
  out += "</ul>\n";
  if (!rest.empty())
    out += fmt::format(
        "<details><summary>{}</summary>\n<ul class=\"sentences\">\n{}</ul>\n<p "
        "class=\"note\">{}gyrostat "
        "report DIR --cell NAME shows one of them in full.</p></details>\n",
        counted(others, "other cell"), rest,
        others > most ? fmt::format("These are the first {}. ", most) : "");
  return out + "</section>\n";
}

std::string failures(const Store& store, const Manifest& manifest) {
  constexpr std::size_t most = 30;
  std::string rows;
  std::size_t count = 0;
  store.for_each_failure([&](const Failure& failure) {
    if (++count > most) return;
    const auto& cell = manifest.cells.at(failure.cell);
    rows += fmt::format(
        "<tr><td class=\"text\"><code>gyrostat replay {}</code></td><td "
        "class=\"text\">{}</td></tr>\n",
        escaped(
            address_text(manifest.name, cell.name, failure.trial, cell.methods.at(failure.method))),
        escaped(failure.reason));
  });
  if (count == 0) return "";
  return fmt::format(
      "<section aria-labelledby=\"failures\"><h2 id=\"failures\">Failures</h2>\n<p>{} outcomes are "
      "in quarantine: "
      "the method threw, or left out steps. They stay in every mean that they have a value "
      "for.{}</p>\n<div class=\"scroll\" "
      "tabindex=\"0\" role=\"group\" aria-label=\"Failures\"><table><thead><tr><th>replay</th><th "
      "class=\"text\">why</th>"
      "</tr></thead>\n<tbody>{}</tbody></table></div></section>\n",
      count,
      count > most
          ? fmt::format(" The first {} are here; gyrostat status DIR --failures has all.", most)
          : "",
      rows);
}

std::string foot(const Store& store) {
  std::string builds;
  for (const auto& session : store.sessions()) {
    const auto build = fmt::format("{} ({}, {})", session.build.version, session.build.compiler,
                                   session.build.flags);
    if (session.trials > 0 && builds.find(build) == std::string::npos)
      builds += (builds.empty() ? "" : "; ") + build;
  }
  return fmt::format("<h2>About this page</h2>\n<p class=\"note\">Outcomes by gyrostat {}.</p>\n",
                     escaped(builds));
}

/// What all cells of a report share.
struct ReportSources {
  const Study& study;
  const Store& store;
  const std::filesystem::path& folder;
  const MethodColours& colours;
  const std::map<std::string, std::map<std::string, double>>& times;
  const ReportOptions& options;
};

/// Hands `show` all that a cell in full is made of.
template <class Show>
void in_full(const ReportSources& from, std::size_t c, const CellSummary& summary,
             const CellRanking& ranking, const Show& show) {
  const auto& cell = from.study.cells[c];
  const auto prepared = prepare_or_note(cell, from.study.seed, from.options.threads);
  const auto replay =
      prepared.thrown.empty()
          ? std::min(from.options.replay.value_or(trials_to_replay(cell)), cell.trials)
          : 0;
  const auto replayed = replay > 0 ? replay_trials(prepared, from.study.seed, replay) : Replayed{};
  const auto values = cell_values(cell, from.store, static_cast<std::uint32_t>(c));
  CellView view{from.study,
                cell,
                from.colours,
                summary,
                values,
                best_first(cell, summary),
                fmt::format("cell-{}", c)};
  if (cell.failure)
    view.failure = failure_view(from.study, from.store, static_cast<std::uint32_t>(c), from.folder,
                                prepared, replay > 0);
  const auto measured = from.times.find(cell.name);
  show(view, ranking, prepared, replayed,
       measured == from.times.end() ? std::map<std::string, double>() : measured->second);
}

std::optional<tbb::global_control> limited(int threads) {
  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  return limit;
}

}  // namespace

std::string report_page(const Study& study, const Store& store, const std::filesystem::path& folder,
                        const ReportOptions& options) {
  const auto limit = limited(options.threads);
  const auto manifest = store.manifest();
  const MethodColours colours(study);
  const auto sweeps = sweeps_of(study);
  const auto chosen = chosen_cells(study, options.cells);
  const auto designs = by_design(study, store);
  const auto times = run_times(folder / "log.jsonl");

  std::vector<CellSummary> summaries;
  std::vector<CellRanking> rankings;
  // Cells in full are simulated again, in part.
  constexpr double share_of_reading = 0.3;
  const auto tell = [&](const char* phase, std::size_t c, double share) {
    if (options.progress) options.progress(phase, study.cells[c].name, share);
  };
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    tell("reading trials", c, share_of_reading * c / static_cast<double>(study.cells.size()));
    const auto trials = trials_of(study.cells[c], store, c);
    summaries.push_back(summarise_cell(study.cells[c], trials));
    const bool is_seen =
        !serves_a_design(study, c) || std::find(chosen.begin(), chosen.end(), c) != chosen.end();
    rankings.push_back(is_seen ? rank_cell(study.cells[c], trials) : CellRanking{});
  }

  std::string body = in_short(study, rankings, chosen, designs);
  body += sweep_sections(study, sweeps, summaries, colours);
  body += sensitivity_sections(designs, colours);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto c = chosen[k];
    if (summaries[c].finished == 0) continue;
    tell("drawing", c,
         share_of_reading + (1.0 - share_of_reading) * static_cast<double>(k) /
                                static_cast<double>(chosen.size()));
    in_full({study, store, folder, colours, times, options}, c, summaries[c], rankings[c],
            [&](const auto&... cell) { body += cell_section(cell...); });
  }
  body += failures(store, manifest);
  return live_page(fmt::format("{}: gyrostat report", study.name()), head(study, manifest), body,
                   foot(store));
}

std::vector<CellPictures> report_pictures(const Study& study, const Store& store,
                                          const std::filesystem::path& folder,
                                          const ReportOptions& options) {
  const auto limit = limited(options.threads);
  const MethodColours colours(study);
  const auto times = run_times(folder / "log.jsonl");
  std::vector<CellPictures> of_cells;
  for (const std::size_t c : chosen_cells(study, options.cells)) {
    const auto trials = trials_of(study.cells[c], store, static_cast<std::uint32_t>(c));
    const auto summary = summarise_cell(study.cells[c], trials);
    if (summary.finished == 0) continue;
    in_full({study, store, folder, colours, times, options}, c, summary,
            rank_cell(study.cells[c], trials),
            [&](const CellView& view, const CellRanking& ranking, const PreparedCell&,
                const Replayed& replayed, const std::map<std::string, double>& nanoseconds) {
              auto& cell = of_cells.emplace_back(CellPictures{view.cell.name, {}});
              append_pictures({view, ranking, replayed, nanoseconds}, cell.pictures);
              std::erase_if(cell.pictures,
                            [](const Picture& picture) { return picture.marks.empty(); });
            });
  }
  return of_cells;
}

}  // namespace gyrostat
