#include <gyrostat/experiments/pages/page.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <gyrostat/experiments/coverage/coverage.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

std::string contents_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), "cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

const Table& table_named(const std::vector<NamedTable>& tables, const std::string& name,
                         const std::string& place) {
  std::vector<std::string> names;
  for (const auto& [known, table] : tables) {
    if (known == name) return table;
    names.push_back(known);
  }
  throw InputError(place, unknown_name("table", name, names));
}

/// "a" or "a / b": as many of the row's first cells as the label has parts.
bool is_called(const std::vector<TableCell>& row, const std::string& label) {
  std::string name;
  for (const auto& cell : row) {
    name += (name.empty() ? "" : " / ") + render_detail::readable(cell);
    if (name == label) return true;
    if (name.size() > label.size()) break;
  }
  return false;
}

std::string cell_text(const Table& table, const std::string& row, const std::string& column,
                      const std::string& place) {
  const auto at = std::find_if(table.columns.begin(), table.columns.end(),
                               [&](const TableColumn& c) { return c.name == column; });
  if (at == table.columns.end()) {
    std::vector<std::string> names;
    for (const auto& c : table.columns) names.push_back(c.name);
    throw InputError(place, unknown_name("column", column, names));
  }
  for (const auto& cells : table.rows)
    if (is_called(cells, row))
      return render_detail::readable(cells[static_cast<std::size_t>(at - table.columns.begin())]);
  throw InputError(place, "no row '" + row + "' in '" + table.title + "'");
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

class Filler {
 public:
  Filler(const Page& page, const std::vector<NamedTable>& tables)
      : folder_(page.folder), place_((fs::path(page.folder) / "page.md").string()), own_(tables) {}

  std::string operator()(const std::string& mark) {
    const std::string place = place_ + ": {{" + mark + "}}";
    if (mark.starts_with("table ")) {
      const auto [tables, name] = named(mark.substr(6));
      const Table& table = table_named(*tables, name, place);
      auto text = render(std::span(&table, 1), Format::markdown);
      while (text.ends_with('\n')) text.pop_back();
      return text;
    }
    std::vector<std::string> parts = {""};
    for (const char c : mark)
      if (c == '|')
        parts.emplace_back();
      else
        parts.back() += c;
    if (parts.size() != 3) throw InputError(place, "not {{NAME | row | column}}");
    const auto [tables, name] = named(parts[0]);
    return cell_text(table_named(*tables, name, place), trimmed(parts[1]), trimmed(parts[2]),
                     place);
  }

 private:
  /// "NAME" of this page, or "TOPIC: NAME" of another.
  std::pair<const std::vector<NamedTable>*, std::string> named(const std::string& text) {
    const auto colon = text.find(':');
    if (colon == std::string::npos) return {&own_, trimmed(text)};
    return {&of(trimmed(text.substr(0, colon))), trimmed(text.substr(colon + 1))};
  }

  const std::vector<NamedTable>& of(const std::string& topic) {
    if (!others_.contains(topic))
      others_[topic] = read_page_tables((fs::path(folder_) / ".." / topic).string());
    return others_[topic];
  }

  std::string folder_, place_;
  const std::vector<NamedTable>& own_;
  std::map<std::string, std::vector<NamedTable>> others_;
};

/// The name of a table is that of a file in the page's folder.
void require_file_name(const std::string& name, const std::string& place) {
  const bool is_plain =
      !name.empty() && name.front() != '.' &&
      std::ranges::all_of(name, [](unsigned char c) { return c > ' ' && c != '/' && c != 127; });
  if (!is_plain)
    throw InputError(place, Json(name).dump() +
                                " is no name of a table: no '/', no blanks, no '.' at its front");
}

void append(std::vector<NamedTable>& all, std::vector<NamedTable> more) {
  for (auto& named : more) all.push_back(std::move(named));
}

std::string beside(const Page& page, const std::string& file) {
  return (fs::path(page.folder) / file).lexically_normal().string();
}

std::vector<NamedTable> source_tables(const Page& page, const Json& source,
                                      const std::string& place, const RunCell& run,
                                      const RunMatch& match) {
  JsonObject object(source, place);
  std::vector<NamedTable> tables;
  if (object.has("ledger")) {
    const Ledger ledger = read_ledger(beside(page, object.text("ledger", "")));
    auto made = ledger_tables(ledger, judge(ledger, run));
    tables = {{"claims", std::move(made[0])}, {"findings", std::move(made[1])}};
  } else if (object.has("match")) {
    const auto name = object.text("name", "match");
    const Match wanted = read_match(beside(page, object.text("match", "")));
    auto made = match_tables(wanted, match(wanted));
    tables = {{name + "_scenario", std::move(made[0])},
              {name, std::move(made[1])},
              {name + "_summary", std::move(made[2])}};
  } else if (object.has("coverage")) {
    const auto wanted = read_coverage(beside(page, object.text("coverage", "")));
    tables = {{"coverage", coverage_table(wanted, measure_coverage(wanted, run))}};
  } else {
    const auto study = beside(page, object.required_text("study"));
    tables = study_tables(study, object.list("tables"), run);
  }
  object.finish();
  return tables;
}

}  // namespace

Page read_page(const std::string& folder) {
  const auto file = (fs::path(folder) / "page.json").string();
  const Json json = read_json(file);
  JsonObject object(json, file + ":");
  Page page{.folder = folder,
            .output = object.text("output", "README.md"),
            .sources = {},
            .places = {},
            .figures = {},
            .text = contents_of(fs::path(folder) / "page.md")};
  for (const auto& [source, place] : object.list("sources")) {
    page.sources.push_back(*source);
    page.places.push_back(place);
  }
  for (const auto& [figure, place] : object.list("figures")) page.figures.push_back(*figure);
  object.finish();
  return page;
}

std::vector<NamedTable> page_tables(const Page& page, const RunCell& run, const RunMatch& match) {
  std::vector<NamedTable> tables;
  for (std::size_t i = 0; i < page.sources.size(); ++i)
    append(tables, source_tables(page, page.sources[i], page.places[i], run, match));
  for (const auto& named : tables) require_file_name(named.name, page.folder);
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (tables[i].name == tables[j].name)
        throw InputError(page.folder, "two tables are called '" + tables[i].name + "'");
  return tables;
}

std::string page_text(const Page& page, const std::vector<NamedTable>& tables) {
  Filler fill(page, tables);
  const std::string& text = page.text;
  std::string out;
  std::size_t done = 0;
  for (std::size_t open; (open = text.find("{{", done)) != std::string::npos;) {
    const auto close = text.find("}}", open);
    if (close == std::string::npos)
      throw InputError((fs::path(page.folder) / "page.md").string(), "a {{ is never closed");
    out.append(text, done, open - done);
    out += fill(text.substr(open + 2, close - open - 2));
    done = close + 2;
  }
  return out.append(text, done);
}

std::vector<std::pair<std::string, std::string>> page_files(const std::vector<NamedTable>& tables) {
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<Table> plain;
  Json names = Json::array();
  for (const auto& [name, table] : tables) {
    files.emplace_back(name + ".csv", render(std::span(&table, 1), Format::csv));
    plain.push_back(table);
    names.push_back(name);
  }
  const Json all = {{"names", names}, {"tables", Json::parse(render(plain, Format::json))}};
  files.emplace_back("tables.json", all.dump(1) + '\n');
  return files;
}

std::vector<NamedTable> read_page_tables(const std::string& folder) {
  const auto file = (fs::path(folder) / "tables.json").string();
  const Json json = read_json(file);
  if (!json.is_object() || !json.contains("names") || !json.contains("tables"))
    throw InputError(file, "\"names\" or \"tables\" is missing");
  auto tables = parse_tables(json.at("tables").dump(), file);
  if (!json.at("names").is_array() || json.at("names").size() != tables.size())
    throw InputError(file, "there are not as many names as tables");
  std::vector<NamedTable> named;
  for (const auto& name : json.at("names")) {
    if (!name.is_string()) throw InputError(file, name.dump() + " in \"names\" is not a text");
    require_file_name(name.get<std::string>(), file);
  }
  for (std::size_t i = 0; i < tables.size(); ++i)
    named.push_back({json.at("names")[i].get<std::string>(), std::move(tables[i])});
  return named;
}

}  // namespace gyrostat
