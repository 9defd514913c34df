#include <gyrostat/experiments/findings/report/cell_section.hpp>

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/findings/error_tables.hpp>
#include <gyrostat/experiments/findings/report/picture.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {
namespace {

/// The first sentence stands at the top of the page, with what is said of other cells.
std::string all_but_the_first(const std::vector<std::string>& sentences) {
  if (sentences.size() < 2) return "";
  std::string out = "<ul class=\"sentences\">\n";
  for (const auto& sentence : std::span(sentences).subspan(1))
    out += fmt::format("<li>{}</li>\n", escaped(sentence));
  return out + "</ul>\n";
}

/// Counts of what never happened tell nothing.
void leave_out_zeros(Table& table) {
  const auto is_none = [](const TableCell& cell) {
    const auto* text = std::get_if<std::string>(&cell);
    return text != nullptr && text->starts_with("0/");
  };
  for (std::size_t c = table.columns.size(); c-- > 0;) {
    const auto column = static_cast<std::ptrdiff_t>(c);
    if (!std::ranges::all_of(table.rows, [&](const auto& row) { return is_none(row[c]); }))
      continue;
    table.columns.erase(table.columns.begin() + column);
    for (auto& row : table.rows) row.erase(row.begin() + column);
  }
}

Table ranking_table(const CellView& v, const CellRanking& ranking) {
  const auto& unit = ranking.unit;
  Table table{.title = "Ranking by " + v.values.title,
              .columns = {{"method", ""},
                          {"mean", unit},
                          {"± 95 %", unit},
                          {"median", unit},
                          {"worst 5 %, mean", unit},
                          {"worst", unit},
                          {"mean rank", ""},
                          {"diverged", ""},
                          {"broke down", ""},
                          {"threw", ""}}};
  for (const auto& ranked : ranking.methods) {
    std::size_t m = 0;
    while (m + 1 < v.cell.methods.size() && v.cell.methods[m].id != ranked.method) ++m;
    const auto& method = v.summary.methods[m];
    const auto count = [&](std::size_t n) {
      return TableCell(fmt::format("{}/{}", n, v.summary.finished));
    };
    table.rows.push_back({ranked.method, cell(ranked.mean), cell(ranked.half_width),
                          cell(v.summary.of(m, ranking.metric).median), cell(ranked.cvar95),
                          cell(ranked.worst), cell(ranked.mean_rank), count(method.diverged),
                          count(method.broken_down), count(method.thrown)});
  }
  leave_out_zeros(table);
  return table;
}

/// The worst trials of each method, with what replays them.
std::string worst_table(const CellView& v) {
  constexpr std::size_t each = 3;
  std::string out = fmt::format(
      "<details><summary>Worst trials, and how to replay them</summary>\n<div class=\"scroll\" "
      "tabindex=\"0\" role=\"group\" aria-label=\"Worst trials\"><table><thead><tr><th>method</th>"
      "<th>trial</th><th>{} [{}]</th><th class=\"text\">replay</th></tr></thead>\n<tbody>",
      escaped(v.values.metric), escaped(v.values.unit));
  for (const std::size_t m : v.order)
    for (const std::size_t place : worst_trials(v.values.values[m], each))
      out += fmt::format(
          "<tr><th scope=\"row\">{}</th><td>{}</td><td>{:.4g}</td><td "
          "class=\"text\"><code>gyrostat replay "
          "{}</code></td></tr>\n",
          escaped(v.cell.methods[m].id), v.values.trials[place], v.values.values[m][place],
          escaped(v.address(place, m)));
  return out + "</tbody></table></div></details>\n";
}

std::string tables(const CellView& v, const PreparedCell& prepared) {
  std::string out = "<details><summary>All tables of this cell</summary>\n";
  if (v.cell.needs_calibration())
    out += html(calibration_table(v.cell, prepared.calibration, v.summary));
  if (const auto tuned = tuning_table(v.cell, prepared.tuned); !tuned.rows.empty())
    out += html(tuned);
  for (const auto& table : error_tables(v.cell, v.summary)) out += html(table);
  return out + "</details>\n";
}

/// A warning where trials simulated again do not come out as the store has them.
std::string disagreement(const CellView& v, const Replayed& replayed) {
  const auto [compared, different] = compare(replayed, v.values);
  if (different == 0) return "";
  return fmt::format(
      "<p class=\"note\"><strong>Pictures over time are of trials simulated again, and {} of {} "
      "did not come out as the store has them:</strong> its outcomes are of another build.</p>\n",
      different, compared);
}

}  // namespace

std::string cell_section(const CellView& v, const CellRanking& ranking,
                         const PreparedCell& prepared, const Replayed& replayed,
                         const std::map<std::string, double>& nanoseconds) {
  std::string out =
      fmt::format("<section id=\"{}\" aria-labelledby=\"{}-title\">\n<h2 id=\"{}-title\">{}</h2>\n",
                  v.id, v.id, v.id, escaped(v.cell.name));
  out += fmt::format("<p class=\"note\">{} of {} finished, all methods on the same signals</p>\n",
                     v.summary.finished, counted(v.cell.trials, "trial"));
  out += disagreement(v, replayed) + all_but_the_first(ranking.sentences) +
         html(ranking_table(v, ranking));
  if (v.failure) out += html(failure_table(v.cell, v.failure->findings));
  std::vector<Picture> pictures;
  append_pictures({v, ranking, replayed, nanoseconds}, pictures);
  out += "<div class=\"pictures\">\n";
  for (const auto& picture : pictures)
    if (!picture.marks.empty()) out += html(picture);
  out += "</div>\n";
  return out + worst_table(v) + tables(v, prepared) + "</section>\n";
}

}  // namespace gyrostat
