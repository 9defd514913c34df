#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/pages/ledger.hpp>
#include <gyrostat/experiments/pages/matching.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {

/// A published page: page.json says which tables to make of which studies, page.md is the text with
/// {{…}} where tables and numbers go, README.md is what comes out.
struct Page {
  std::string folder;
  std::string output;  ///< the page, by a path from the folder
  std::vector<Json>
      sources;  ///< each a study with its tables, a ledger, a match or a coverage study
  std::vector<std::string> places;
  std::vector<Json> figures;  ///< each lines or a heat map of one of the tables
  std::string text;
};

Page read_page(const std::string& folder);

using RunCell = std::function<CellResult(const Study&, const Cell&)>;
using RunMatch = std::function<MatchResult(Match)>;

/// Runs everything that the page names.
std::vector<NamedTable> page_tables(const Page& page, const RunCell& run, const RunMatch& match);

/// The tables of one study, as `specs` (the entries of "tables") ask for them.
std::vector<NamedTable> study_tables(const std::string& study,
                                     const std::vector<std::pair<const Json*, std::string>>& specs,
                                     const RunCell& run);

/// The page's text with every {{…}} filled in:
///   {{table NAME}}                 the table, or {{table TOPIC: NAME}} of a neighbouring page
///   {{NAME | row | column}}        one of its cells; a row is named by its first cells, "a / b"
///   {{TOPIC: NAME | row | column}} a cell of a neighbouring page
/// Numbers in the text are thus the data's. InputError where there is no such thing.
std::string page_text(const Page& page, const std::vector<NamedTable>& tables);

/// The data of a page as files by name: tables.json, and a CSV for each table.
std::vector<std::pair<std::string, std::string>> page_files(const std::vector<NamedTable>& tables);

/// The page's figures as SVG files by name.
std::vector<std::pair<std::string, std::string>> page_figures(
    const Page& page, const std::vector<NamedTable>& tables);

/// The tables back from tables.json of a page's folder.
std::vector<NamedTable> read_page_tables(const std::string& folder);

}  // namespace gyrostat
