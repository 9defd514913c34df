// The blind check's recordings, and its score of diagnoses whose right answers are known.

#include <gyrostat/experiments/blind/blind_check.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/experiments/blind/blind_score.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::gap::blind_check_test {
namespace {

constexpr auto check_json = R"({
 "seed": 3, "recordings": 2, "none_recordings": 1, "durations_s": [60, 120],
 "scenarios": {"still": {"rate_hz": 20}},
 "cases": [{"effect": "outliers", "scenario": "still", "strong": {}, "weak": {"std_dps": 0.1}}]
})";

TEST(BlindCheck, MakesEveryCaseAtEveryLengthUnderNumbersThatTellNothing) {
  TestFolder folder;
  folder.write("check.json", check_json);
  const auto check = read_blind_check((folder.path() / "check.json").string());
  make_recordings(check, folder.path());
  const auto labels = open_labels(folder.path());
  ASSERT_EQ(labels.size(), 2 * (1 + 2 + 2));
  std::map<std::pair<std::string, double>, int> counts;
  std::vector<double> lengths;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const auto& label = labels[k];
    EXPECT_EQ(label.number, k);
    EXPECT_EQ(label.effects.empty(), label.strength.empty());
    ++counts[{label.strength, label.duration_s}];
    lengths.push_back(label.duration_s);
    const auto read =
        read_recording((folder.path() / fmt::format("recordings/{:05}.csv.gz", k)).string(), "");
    EXPECT_EQ(read.series.size(), static_cast<std::size_t>(20 * label.duration_s));
    EXPECT_TRUE(read.series.random_error_dps.empty());
    EXPECT_TRUE(read.series.thermal_bias_dps.empty());
    EXPECT_TRUE(read.series.rate_ref_dps.empty());  // nothing moves
  }
  for (const double duration_s : {60.0, 120.0}) {
    EXPECT_EQ((counts[{"", duration_s}]), 1);
    EXPECT_EQ((counts[{"strong", duration_s}]), 2);
    EXPECT_EQ((counts[{"weak", duration_s}]), 2);
  }
  EXPECT_FALSE(std::is_sorted(lengths.begin(), lengths.end()));
}

TEST(BlindCheck, KeepsToTheFolderOfItsOwnRecordings) {
  TestFolder folder;
  folder.write("check.json", check_json);
  auto check = read_blind_check((folder.path() / "check.json").string());
  const auto out = folder.path() / "out";
  make_recordings(check, out);
  make_recordings(check, out);  // the same again goes on
  check.recordings = 3;
  EXPECT_THROW(make_recordings(check, out), InputError);
  check.recordings = 2;
  check.file["seed"] = 4;
  EXPECT_THROW(make_recordings(check, out), InputError);
}

// Whoever adds an effect adds it to the check, under conditions that show it.
TEST(BlindCheck, DrawsEveryEffectWhereItCanBeSeen) {
  const auto check =
      read_blind_check(std::string(GYROSTAT_SOURCE_DIR) + "/experiments/studies/blind_check.json");
  std::map<std::string, std::vector<std::string>> strengths;
  for (auto c : check.cases) {
    if (c.effects.size() != 1) continue;
    strengths[c.effects.front()].push_back(c.strength);
    Series with, without;
    synthesise(c.scenario, {1, 0}, with);
    c.scenario.effects.clear();
    synthesise(c.scenario, {1, 0}, without);
    EXPECT_TRUE(with.gyro_dps != without.gyro_dps || with.heading_deg != without.heading_deg)
        << c.effects.front();
  }
  for (const auto& id : effect_types().ids())
    EXPECT_THAT(strengths[id], testing::ElementsAre("strong", "medium")) << id;
  EXPECT_EQ(strengths.size(), effect_types().ids().size());
}

class Scored : public testing::Test {
 protected:
  void diagnosed(BlindLabel label, const std::string& verdict,
                 const std::vector<std::string>& added, bool left_out = false) {
    if (!left_out) {
      label.number = labels_.size();
      labels_.push_back(label);
    }
    Json found = {{"verdict", verdict},
                  {"verdict_set", added},
                  {"gap", {{"closed", added.empty() ? 0.0 : 0.9}}},
                  {"causes", Json::array()},
                  {"steps", {{{"added", ""}}}}};
    for (const auto& effect : added) {
      found["steps"].push_back({{"added", effect}});
      found["causes"].push_back({{"effect", effect}, {"probability", 0.9}});
    }
    folder_.write(std::filesystem::relative(
                      diagnosis_of(folder_.path(), labels_.size() - 1, left_out), folder_.path())
                      .string(),
                  found.dump());
  }

  std::map<std::string, Table> tables() {
    seal_labels(folder_.path(), labels_);
    std::map<std::string, Table> all;
    for (auto& [name, table] : score_recordings("Check", folder_.path())) all[name] = table;
    return all;
  }

  TestFolder folder_;
  std::vector<BlindLabel> labels_;
};

std::string text(const Table& table, const std::string& row, const std::string& column) {
  for (const auto& cells : table.rows)
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (std::get<std::string>(cells[0]) == row && table.columns[c].name == column)
        return std::get<std::string>(cells[c]);
  return "nothing in " + row + ", " + column;
}

TEST_F(Scored, CountsWhatWasNamedAndWhatWasNot) {
  const BlindLabel strong{0, {"outliers"}, "strong", 60.0}, none{0, {}, "", 60.0};
  diagnosed(strong, "outliers", {"outliers"});
  diagnosed(strong, "unknown", {}, true);
  diagnosed(strong, "telegraph", {"telegraph", "outliers"});
  diagnosed(strong, "quantization", {"quantization"}, true);
  diagnosed(strong, "none", {});
  diagnosed(none, "none", {});
  diagnosed(none, "telegraph", {"telegraph"});
  const BlindLabel pair{0, {"outliers", "vibration"}, "strong", 60.0};
  diagnosed(pair, "vibration", {"vibration", "outliers"});
  diagnosed(pair, "vibration", {"vibration", "vibration"});
  labels_.push_back({labels_.size(), {"outliers"}, "strong", 60.0});  // never diagnosed
  auto all = tables();
  const auto& aims = all["aims"];
  using testing::StartsWith;
  EXPECT_THAT(text(aims, "strong", "named first"), StartsWith("33 % (1 of 3;"));
  EXPECT_THAT(text(aims, "strong", "in the set"), StartsWith("67 % (2 of 3;"));
  EXPECT_THAT(text(aims, "strong", "abstained without it"), StartsWith("50 % (1 of 2;"));
  EXPECT_THAT(text(aims, "none", "named first"), StartsWith("50 % (1 of 2;"));
  EXPECT_THAT(text(aims, "two effects, strong", "named first"), StartsWith("100 % (2 of 2;"));
  EXPECT_THAT(text(aims, "two effects, strong", "both named"), StartsWith("50 % (1 of 2;"));
  EXPECT_THAT(aims.notes, testing::Contains("1 recordings have no diagnosis"));
  EXPECT_EQ(text(all["effects"], "outliers", "taken for"), "none 1, telegraph 1");
  EXPECT_EQ(text(all["left_out"], "outliers", "verdicts"), "quantization 1, unknown 1");
  EXPECT_THAT(text(all["calibration"], "0.8 to 1.0", "right"), StartsWith("67 % (2 of 3;"));
  EXPECT_FALSE(all.contains("power"));  // one length
}

TEST_F(Scored, TellsHowPowerGrowsWithStrengthAndLength) {
  for (const double duration_s : {60.0, 120.0})
    for (const std::string strength : {"weak", "strong"})
      for (int k = 0; k < 4; ++k) {
        const bool found = duration_s == 120.0 ? true : strength == "strong" && k < 2;
        diagnosed({0, {"outliers"}, strength, duration_s}, found ? "outliers" : "none", {});
      }
  auto all = tables();
  EXPECT_EQ(text(all["power"], "outliers", "60 s"), "2 of 4");
  EXPECT_EQ(text(all["power"], "outliers", "120 s"), "4 of 4");
  const auto& lengths = all["lengths"];
  ASSERT_EQ(lengths.rows.size(), 2u);
  const auto number = [&](std::size_t row, const std::string& column) {
    for (std::size_t c = 0; c < lengths.columns.size(); ++c)
      if (lengths.columns[c].name == column) return std::get<double>(lengths.rows[row][c]);
    return no_value;
  };
  EXPECT_EQ(number(0, "length"), 60.0);
  EXPECT_EQ(number(0, "weak"), 0.0);
  EXPECT_EQ(number(0, "strong"), 50.0);
  EXPECT_LT(number(0, "lower strong"), 50.0);
  EXPECT_GT(number(0, "upper strong"), 50.0);
  EXPECT_EQ(number(1, "weak"), 100.0);
}

}  // namespace
}  // namespace gyrostat::gap::blind_check_test
