#include <gyrostat/results/render/render.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/error.hpp>

namespace gyrostat::render_test {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string rendered(const Table& table, Format format) { return render({&table, 1}, format); }

/// A table of one text column with these cells.
Table texts(const std::vector<std::string>& cells) {
  Table table{.title = "title", .columns = {{"text", ""}}};
  for (const auto& text : cells) table.rows.push_back({text});
  return table;
}

/// A table of one row of numbers in dps.
Table numbers(const std::vector<TableCell>& cells) {
  Table table{.title = "title", .columns = {}, .rows = {cells}};
  for (std::size_t i = 0; i < cells.size(); ++i)
    table.columns.push_back({"column " + std::to_string(i), "dps"});
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t characters(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; }));
}

TEST(Render, FormatsHaveTheirNames) {
  EXPECT_THAT(format_names(), testing::ElementsAre("text", "md", "csv", "json", "latex"));
  EXPECT_EQ(format_named("md"), Format::markdown);
  try {
    format_named("jsn");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("'jsn'"), HasSubstr("'json'")));
  }
}

TEST(Render, TextFitsAScreenAndLosesNothing) {
  Table table{
      .title = std::string(70, 't') + " of more than a line",
      .columns = {{"name", ""}},
      .notes = {"a note of so many words that it goes on and on and on until it is longer than "
                "any line of a screen may be"}};
  for (int c = 0; c < 12; ++c) table.columns.push_back({"column " + std::to_string(c), "dps"});
  table.columns.push_back({"meaning", ""});
  for (int r = 0; r < 3; ++r) {
    auto& row = table.rows.emplace_back();
    row.push_back("row " + std::to_string(r));
    for (int c = 0; c < 12; ++c) row.push_back(std::int64_t{1000 * r + c});
    row.push_back(
        std::string("words that say what it is about, and more of them than fit beside it, "
                    "up to the last-one"));
  }
  const auto text = rendered(table, Format::text);
  for (const auto& line : lines_of(text)) EXPECT_LE(characters(line), 80U) << line;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 12; ++c) EXPECT_THAT(text, HasSubstr(" " + std::to_string(1000 * r + c)));
  EXPECT_THAT(text, HasSubstr("last-one"));
}

TEST(Render, RunningTextKeepsItsLinesAndWhatTheyAreIndentedBy) {
  std::string words;
  for (int i = 0; i < 30; ++i) words += (i ? " word" : "word") + std::to_string(i);
  const auto lines = lines_of(wrapped("short\n\n    " + words, 2));
  ASSERT_GT(lines.size(), 4U);
  EXPECT_EQ(lines[0], "short");
  EXPECT_EQ(lines[1], "");
  EXPECT_THAT(lines[2], testing::StartsWith("    word0"));
  for (std::size_t i = 3; i < lines.size(); ++i)
    EXPECT_THAT(lines[i], testing::StartsWith("      word"));
  std::string again;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    EXPECT_LE(lines[i].size(), 80U);
    again += (i > 2 ? " " : "") + lines[i].substr(lines[i].find('w'));
  }
  EXPECT_EQ(again, words);
}

TEST(Render, CsvQuotesWhatWouldBreakARow) {
  const auto lines = rendered(texts({"plain", "a,b", "say \"no\"", "two\nlines"}), Format::csv);
  EXPECT_EQ(lines, "# title\ntext\nplain\n\"a,b\"\n\"say \"\"no\"\"\"\n\"two\nlines\"\n");
}

TEST(Render, ATitleOfTwoLinesStaysAComment) {
  Table table = texts({"cell"});
  table.title = "first\nsecond";
  for (const auto& line : lines_of(rendered(table, Format::csv)))
    EXPECT_TRUE(line.starts_with("#") || line == "text" || line == "cell") << line;
}

TEST(Render, NumbersForProgramsReadBackAsTheSameBits) {
  const std::vector<double> values = {0.1, 1.0 / 3.0, std::numbers::pi * 1e-300, -0.0, 5e-324};
  const Table table = numbers({values.begin(), values.end()});
  const auto json = nlohmann::json::parse(rendered(table, Format::json));
  std::istringstream csv(lines_of(rendered(table, Format::csv)).at(2));
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::string cell;
    std::getline(csv, cell, ',');
    const auto bits = std::bit_cast<std::uint64_t>(values[i]);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(cell.c_str(), nullptr)), bits) << cell;
    const auto number = json[0]["rows"][0][i].get<double>();
    EXPECT_EQ(std::bit_cast<std::uint64_t>(number), bits) << number;
  }
}

TEST(Render, WholeNumbersStayWhole) {
  const Table table = numbers({std::int64_t{12345678901}});
  for (const auto format :
       {Format::text, Format::markdown, Format::csv, Format::json, Format::latex})
    EXPECT_THAT(rendered(table, format), HasSubstr("12345678901"));
}

TEST(Render, AReaderGetsFourDigits) {
  const Table table = numbers({std::numbers::pi});
  for (const auto format : {Format::text, Format::markdown, Format::latex}) {
    EXPECT_THAT(rendered(table, format), HasSubstr("3.142"));
    EXPECT_THAT(rendered(table, format), Not(HasSubstr("3.1415")));
  }
}

/// No reader believes "1e-300"; a program gets the number.
TEST(Render, ASmallProbabilityIsToldAsABoundInEveryColumnOfP) {
  for (const auto* name : {"p", "p, family-wise", "p adjusted"}) {
    const Table table{.title = "t", .columns = {{name, "1"}}, .rows = {{4.6e-250}, {0.04}}};
    EXPECT_THAT(rendered(table, Format::text), Not(HasSubstr("e-250"))) << name;
    EXPECT_THAT(rendered(table, Format::text), HasSubstr("< 1e-6")) << name;
    EXPECT_THAT(rendered(table, Format::text), HasSubstr("0.04")) << name;
    EXPECT_THAT(rendered(table, Format::csv), HasSubstr("e-250")) << name;
  }
}

TEST(Render, NoValueIsADashForReadersAndNothingForPrograms) {
  for (const TableCell& none : {TableCell{}, cell(nan)}) {
    const Table table = numbers({1.0, none, 2.0});
    EXPECT_THAT(rendered(table, Format::text), HasSubstr("–"));
    EXPECT_THAT(rendered(table, Format::markdown), HasSubstr("| 1 | – | 2 |"));
    EXPECT_THAT(rendered(table, Format::latex), HasSubstr("1 & -- & 2 \\\\"));
    EXPECT_EQ(lines_of(rendered(table, Format::csv)).at(2), "1,,2");
    EXPECT_TRUE(nlohmann::json::parse(rendered(table, Format::json))[0]["rows"][0][1].is_null());
  }
}

TEST(Render, ANanThatWasNotMadeACellIsNoNumberEither) {
  const Table table = numbers({nan});
  for (const auto format : {Format::text, Format::markdown, Format::csv, Format::latex})
    EXPECT_THAT(rendered(table, format), Not(HasSubstr("nan")));
  EXPECT_TRUE(nlohmann::json::parse(rendered(table, Format::json))[0]["rows"][0][0].is_null());
}

TEST(Render, AnInfinityIsSaidInEveryFormat) {
  const Table table = numbers({infinity, -infinity});
  for (const auto format : {Format::text, Format::markdown, Format::csv, Format::latex})
    EXPECT_THAT(rendered(table, format), HasSubstr("inf"));
  const auto row = nlohmann::json::parse(rendered(table, Format::json))[0]["rows"][0];
  EXPECT_EQ(row[0], "inf");
  EXPECT_EQ(row[1], "-inf");
}

TEST(Render, JsonKeepsEveryText) {
  const std::vector<std::string> cells = {"say \"no\"", "back\\slash", "two\nlines", "tab\t°C χ²"};
  Table table = texts(cells);
  table.notes = {"a \"note\""};
  const auto json = nlohmann::json::parse(rendered(table, Format::json));
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(json[0]["rows"][i][0], cells[i]);
  EXPECT_EQ(json[0]["notes"][0], table.notes[0]);
  EXPECT_EQ(json[0]["columns"][0]["name"], "text");
}

TEST(Render, JsonTakesATextThatIsNotUtf8) {
  EXPECT_NO_THROW(nlohmann::json::parse(rendered(texts({"name\xff"}), Format::json)));
}

TEST(Render, MarkdownKeepsItsBars) {
  const auto out = rendered(texts({"a|b", "back\\slash", "|x|"}), Format::markdown);
  EXPECT_THAT(out, HasSubstr("| a\\|b |"));
  EXPECT_THAT(out, HasSubstr("| back\\\\slash |"));
  EXPECT_THAT(out, HasSubstr("| \\|x\\| |"));
}

TEST(Render, ARowStaysOnOneLineForReaders) {
  for (const auto format : {Format::text, Format::markdown})
    EXPECT_EQ(lines_of(rendered(texts({"two\nlines"}), format)).size(),
              lines_of(rendered(texts({"one line"}), format)).size());
}

TEST(Render, LatexEscapesWhatItWouldRead) {
  const auto out = rendered(texts({R"(50 % & more_of #1 {x} $5 ~ ^ \)"}), Format::latex);
  EXPECT_THAT(out, HasSubstr(R"(50 \% \& more\_of \#1 \{x\} \$5 \textasciitilde{} )"
                             R"(\textasciicircum{} \textbackslash{} \\)"));
}

TEST(Render, LatexPrintsBarsAndAnglesAsTheyAre) {
  const auto out = rendered(texts({"|x| < y > z"}), Format::latex);
  for (const char* command : {"\\textbar{}x\\textbar{}", "\\textless{}", "\\textgreater{}"})
    EXPECT_THAT(out, HasSubstr(command));
}

TEST(Render, LatexHasACommandForEverySignOfTheTables) {
  const auto out = rendered(texts({"± ° ² σ χ φ δ τ · – ≥ μ θ ≤ × − … ³ √"}), Format::latex);
  EXPECT_EQ(characters(out), out.size()) << out;
}

TEST(Render, TextAlignsByCharactersAndNotByBytes) {
  Table table{.title = "title", .columns = {{"Größe", ""}, {"σ", "°C"}}};
  table.rows = {{"ä", 1.5}, {"longer than its head", 1234.5}, {"±±±", TableCell{}}};
  auto lines = lines_of(rendered(table, Format::text));
  lines.erase(lines.begin());
  std::vector<std::size_t> widths;
  for (const auto& line : lines) widths.push_back(characters(line));
  EXPECT_THAT(widths, Each(widths.at(0)));
}

TEST(Render, TextHasNoBlanksAtTheEndOfALine) {
  Table table{.title = "title", .columns = {{"a", ""}, {"b", ""}}, .notes = {"a note"}};
  table.rows = {{"x", "long text"}, {"y", "z"}};
  for (const auto& line : lines_of(rendered(table, Format::text)))
    EXPECT_FALSE(line.ends_with(' ')) << '\'' << line << '\'';
}

TEST(Render, NotesAreInEveryFormatForReadersAndInJson) {
  Table table = texts({"cell"});
  table.notes = {"mind this"};
  for (const auto format :
       {Format::text, Format::markdown, Format::csv, Format::json, Format::latex})
    EXPECT_THAT(rendered(table, format), HasSubstr("mind this"));
}

TEST(Render, ATableWithoutRowsStillHasItsHead) {
  const Table table{.title = "title", .columns = {{"a", "dps"}}};
  for (const auto format : {Format::text, Format::markdown, Format::csv, Format::latex})
    EXPECT_THAT(rendered(table, format), HasSubstr("a [dps]"));
  EXPECT_THAT(nlohmann::json::parse(rendered(table, Format::json))[0]["rows"], SizeIs(0));
}

TEST(Render, NoTablesAreNothingOrAnEmptyList) {
  for (const auto format : {Format::text, Format::markdown, Format::csv, Format::latex})
    EXPECT_EQ(render({}, format), "");
  EXPECT_THAT(nlohmann::json::parse(render({}, Format::json)), SizeIs(0));
}

}  // namespace
}  // namespace gyrostat::render_test
