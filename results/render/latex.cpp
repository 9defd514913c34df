#include <algorithm>
#include <string_view>
#include <utility>

#include <gyrostat/results/render/render.hpp>

namespace gyrostat::render_detail {
namespace {

std::string escaped(std::string_view s) {
  static constexpr std::pair<std::string_view, std::string_view> symbols[] = {
      {"\\", "\\textbackslash{}"},
      {"&", "\\&"},
      {"%", "\\%"},
      {"_", "\\_"},
      {"#", "\\#"},
      {"$", "\\$"},
      {"{", "\\{"},
      {"}", "\\}"},
      {"~", "\\textasciitilde{}"},
      {"^", "\\textasciicircum{}"},
      {"|", "\\textbar{}"},
      {"<", "\\textless{}"},
      {">", "\\textgreater{}"},
      {"°", "\\textdegree{}"},
      {"±", "$\\pm$"},
      {"²", "$^2$"},
      {"σ", "$\\sigma$"},
      {"χ", "$\\chi$"},
      {"φ", "$\\varphi$"},
      {"δ", "$\\delta$"},
      {"τ", "$\\tau$"},
      {"μ", "$\\mu$"},
      {"θ", "$\\theta$"},
      {"·", "$\\cdot$"},
      {"–", "--"},
      {"≥", "$\\ge$"},
      {"≤", "$\\le$"},
      {"×", "$\\times$"},
      {"−", "$-$"},
      {"…", "\\dots{}"},
      {"³", "$^3$"},
      {"√", "$\\surd$"}};
  std::string out;
  while (!s.empty()) {
    bool replaced = false;
    for (const auto& [symbol, command] : symbols) {
      if (!s.starts_with(symbol)) continue;
      out += command;
      s.remove_prefix(symbol.size());
      replaced = true;
      break;
    }
    if (replaced) continue;
    out += s.front();
    s.remove_prefix(1);
  }
  return out;
}

std::string joined(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t c = 0; c < cells.size(); ++c) out += (c == 0 ? "" : " & ") + cells[c];
  return out + " \\\\\n";
}

}  // namespace

std::string latex(const Table& table) {
  std::string out =
      "\\begin{table}\n\\caption{" + escaped(one_line(table.title)) + "}\n\\begin{tabular}{l" +
      std::string(std::max(table.columns.size(), std::size_t{1}) - 1, 'r') + "}\n\\toprule\n";
  std::vector<std::string> heads;
  for (const auto& column : table.columns) heads.push_back(escaped(head(column)));
  out += joined(heads) + "\\midrule\n";
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < row.size(); ++c)
      cells.push_back(escaped(readable(row[c], table.columns[c])));
    out += joined(cells);
  }
  out += "\\bottomrule\n\\end{tabular}\n";
  for (const auto& note : table.notes)
    out += "\\par\\footnotesize " + escaped(one_line(note)) + "\n";
  return out + "\\end{table}\n";
}

}  // namespace gyrostat::render_detail
