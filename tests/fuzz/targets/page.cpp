#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {
namespace {

/// A page of one table that is there, so that figures and text meet it; nothing is run.
void read_figures(const std::filesystem::path& path) {
  const auto page = read_page(path.parent_path().string());
  const auto tables = read_page_tables(page.folder);
  page_text(page, tables);
  page_figures(page, tables);
}

}  // namespace

Target target_page() {
  return {.file = "page.json",
          .seeds = {R"({"sources": [], "figures": [{"name": "f", "kind": "lines", "table": "t",
                       "title": "T", "y_label": "y", "methods": ["rmse"]}]})",
                    R"({"output": "../README.md", "sources": [{"study": "s.json", "tables": []}],
                       "figures": [{"name": "h", "kind": "heat", "table": "t"}]})"},
          .read = read_figures,
          .beside = {{"page.md", "{{t | kf | rmse}}"},
                     {"tables.json", R"({"names": ["t"], "tables": [{"title": "Errors",
                        "columns": [{"name": "tau", "unit": "s"}, {"name": "rmse", "unit": "dps"}],
                        "rows": [["kf", 0.02], ["stf", 0.03]], "notes": []}]})"}}};
}

}  // namespace gyrostat::fuzz
