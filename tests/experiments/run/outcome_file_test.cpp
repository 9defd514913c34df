#include <gyrostat/experiments/run/outcome_file.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/values.hpp>
#include <gyrostat/results/store.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::outcome_file_test {
namespace {

TEST(OutcomeFile, HasTheDigitsOfPrintfAndNothingForWhatIsMissing) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> values = {
      0.1,      -0.0,          1e-5,          6000.0,
      1e16,     1e17,          -1.0 / 3.0,    123456.789,
      1e300,    Limits::max(), Limits::min(), -Limits::denorm_min(),
      INFINITY, -INFINITY,     no_value,      2.2250738585072011e-308};
  Manifest manifest{"d1", "study", 7, "{}", "/", {}, {{"a, b", {"kf"}, 1, 0}}};
  std::string header = "cell,trial,method", row = "\"a, b\",0,kf";
  for (std::size_t i = 0; i < values.size(); ++i) {
    manifest.columns.push_back("m" + std::to_string(i));
    header += "," + manifest.columns.back();
    char printed[40] = "";
    if (!std::isnan(values[i])) std::snprintf(printed, sizeof printed, "%.17g", values[i]);
    row += std::string(",") + printed;
  }
  const TestFolder folder;
  auto store = Store::open_or_create(folder.path(), manifest);
  store.set_cells(manifest.cells);
  store.begin_session({"d1", {"1", "g++", "-O3"}, "here", 1, "2026-01-01T00:00:00Z", "", 0});
  store.write(std::vector{TrialRow{0, 0, true, values, {}}});
  std::string text;
  export_outcomes(store, [&](std::string_view part) { text += part; });
  EXPECT_EQ(text, header + "\n" + row + "\n");
}

}  // namespace
}  // namespace gyrostat::outcome_file_test
