#include <gmock/gmock.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat::parse_test {
namespace {

TEST(ParseTables, GivesBackWhatWasRendered) {
  const std::vector<Table> tables = {{.title = "t",
                                      .columns = {{"a", ""}, {"b", "dps"}},
                                      .rows = {{std::string("x|y"), 0.1}, {std::int64_t{3}, {}}},
                                      .notes = {"n"}},
                                     {.title = "empty", .columns = {}}};
  const auto back = parse_tables(render(tables, Format::json), "here");
  for (const auto format : {Format::json, Format::csv, Format::markdown})
    EXPECT_EQ(render(back, format), render(tables, format));
}

TEST(ParseTables, NamesThePlaceOfAnythingElse) {
  for (const char* json : {"", "{", "[1]", "[{\"title\": 1}]", "{\"a\": 1}"})
    EXPECT_THROW((void)parse_tables(json, "here"), InputError) << json;
}

}  // namespace
}  // namespace gyrostat::parse_test
