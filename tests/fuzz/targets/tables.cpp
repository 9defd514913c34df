#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/results/render/render.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {
namespace {

/// As `publish` does: the tables back, in every format, and the page's text and figures of them.
void read_tables(const std::filesystem::path& path) {
  const auto folder = path.parent_path().string();
  const auto tables = read_page_tables(folder);
  for (const auto& name : format_names())
    for (const auto& named : tables) render({&named.table, 1}, format_named(name));
  page_files(tables);
  const auto page = read_page(folder);
  page_text(page, tables);
  page_figures(page, tables);
}

}  // namespace

Target target_tables() {
  return {.file = "tables.json",
          .seeds = {R"({"names": ["t"], "tables": [{"title": "Errors",
             "columns": [{"name": "method", "unit": ""}, {"name": "rmse", "unit": "dps"},
                         {"name": "±", "unit": "dps"}],
             "rows": [["kf", 0.021, 1e-3], ["stf", null, "inf"]], "notes": ["a note"]}]})"},
          .read = read_tables,
          .beside = {{"page.json", R"({"sources": []})"}, {"page.md", "{{table t}}"}}};
}

}  // namespace gyrostat::fuzz
