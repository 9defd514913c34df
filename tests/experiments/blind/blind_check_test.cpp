// The blind check's recordings, and its score of diagnoses whose right answers are known.

#include <gyrostat/experiments/blind/blind_check.hpp>

#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/experiments/blind/blind_export.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/experiments/blind/blind_score.hpp>
#include <gyrostat/experiments/blind/seal.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/tests/places.hpp>
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

BlindCheck check_of(const TestFolder& folder, const std::string& json) {
  folder.write("check.json", json);
  return read_blind_check((folder.path() / "check.json").string());
}

constexpr auto sets_json = R"({
 "seed": 5, "recordings": 0, "none_recordings": 0, "samplings": [{"duration_s": 120, "rate_hz": 20}],
 "scenarios": {"still": {"effects": [{"effect": "hard_iron"}], "without": ["hard_iron"]}},
 "cases": [
  {"effect": "outliers", "scenario": "still", "strong": {}, "medium": {"std_dps": 0.2}},
  {"effect": "outliers", "form": "heavy_tails", "scenario": "still", "strong": {}},
  {"effect": "sinusoidal", "scenario": "still", "strong": {}, "medium": {"amplitude_dps": 0.005}},
  {"effect": "vibration", "scenario": "still", "strong": {}, "medium": {}},
  {"effect": "wandering_line", "scenario": "still", "strong": {}, "medium": {}},
  {"effect": "scale_factor", "scenario": "still", "strong": {}, "medium": {}},
  {"effect": "stale_samples", "scenario": "still", "strong": {}, "medium": {}, "weak": {}}],
 "never_together": [["vibration", "wandering_line"]],
 "sets": [{"scenario": "still", "sizes": [2, 4], "strengths": ["strong", "mixed"], "recordings": 30, "left_out": 1}]
})";

TEST(BlindCheck, DrawsSetsOfWhatCanBeSeenAndGoesTogether) {
  TestFolder folder;
  const auto check = check_of(folder, sets_json);
  const auto cases = drawn_cases(check);
  ASSERT_EQ(cases.size(), 2u * 2u * 30u);
  std::map<std::string, int> drawn;
  std::map<std::string, int> forms;
  for (const auto& c : cases) {
    EXPECT_TRUE(c.effects.size() == 2 || c.effects.size() == 4);
    EXPECT_EQ(std::set(c.effects.begin(), c.effects.end()).size(), c.effects.size());
    EXPECT_EQ(c.scenario.effects.size(), 1 + c.effects.size());
    EXPECT_FALSE(holds(c.effects, "vibration") && holds(c.effects, "wandering_line"));
    EXPECT_EQ(c.left_out, c.effects.front());
    EXPECT_EQ(c.own, std::vector<std::string>{"hard_iron"});
    EXPECT_EQ(c.without, std::vector<std::string>{"hard_iron"});
    for (const auto& effect : c.effects) ++drawn[effect];
    ++forms[c.form];
  }
  EXPECT_FALSE(drawn.contains("scale_factor"));  // nothing moves
  EXPECT_EQ(drawn.size(), 5u);
  for (const auto& [effect, times] : drawn) EXPECT_GT(times, 30) << effect;
  EXPECT_GT(forms["outliers as heavy_tails"], 10);
  EXPECT_GT(forms[""], 30);

  const auto again = drawn_cases(check);
  for (std::size_t k = 0; k < cases.size(); ++k) EXPECT_EQ(cases[k].effects, again[k].effects);
}

TEST(BlindCheck, RefusesSetsThatItCannotDraw) {
  TestFolder folder;
  auto json = Json::parse(sets_json);
  json["sets"][0]["sizes"] = {5};
  EXPECT_THROW(drawn_cases(check_of(folder, json.dump())), InputError);
}

TEST(BlindCheck, PutsEffectsIntoWhatARealSensorRecorded) {
  TestFolder folder;
  std::string csv = "t_s,gyro_x_dps,gyro_y_dps\n";
  for (int i = 0; i < 400; ++i)
    csv += fmt::format("{:.2f},{:.3f},{:.3f}\n", 0.01 * i, 0.3 + 0.001 * (i % 7), -0.001 * (i % 5));
  folder.write("real/quiet.csv", csv);
  const auto check = check_of(folder, R"({
   "none_recordings": 3, "recordings": 1,
   "scenarios": {"quiet": {"noise": {"folder": "real", "files": ["quiet.csv"], "axes": ["x", "y"],
                                     "duration_s": 3.5},
                           "own": ["quantization"]}},
   "cases": [{"effect": "rate_ramp", "scenario": "quiet", "strong": {"slope_dps_per_s": 0.1}}]})");
  const auto cases = drawn_cases(check);
  ASSERT_EQ(cases.size(), 4u);
  std::vector<std::string> noises;
  for (const auto& c : cases) {
    noises.push_back(label_of(c, 0).noise);
    const auto noise = read_recording(folder.path() / "real/quiet.csv", noises.back().substr(10));
    const Series made = recorded(c, {1, 0});
    ASSERT_EQ(made.size(), 350u);
    EXPECT_TRUE(made.temperature_C.empty() && made.heading_deg.empty());
    if (c.effects.empty()) {
      EXPECT_TRUE(std::equal(made.gyro_dps.begin(), made.gyro_dps.end(),
                             noise.series.gyro_dps.begin()));  // to the bit
    } else {
      EXPECT_NEAR(made.gyro_dps[300] - noise.series.gyro_dps[300], 0.3, 1e-12);
    }
    EXPECT_EQ(c.own, std::vector<std::string>{"quantization"});
  }
  EXPECT_THAT(noises,
              testing::ElementsAre("quiet.csv x", "quiet.csv y", "quiet.csv x", "quiet.csv y"));
}

/// A quarter of a step moves each value by a step with a probability of a quarter; put into what is
/// rounded, it would move none. The bounds are four standard errors: one false failure in 16,000
/// seeds.
TEST(BlindCheck, PutsWhatIsLessThanAStepIntoARecordingThatIsRounded) {
  TestFolder folder;
  constexpr int samples = 4000;
  std::string csv = "t_s,gyro_dps\n";
  for (int i = 0; i < samples; ++i) csv += fmt::format("{:.2f},{:.1f}\n", 0.01 * i, 0.1 * (i % 7));
  folder.write("real/rounded.csv", csv);
  const auto check = check_of(folder, R"({
   "none_recordings": 1, "recordings": 1,
   "scenarios": {"rounded": {"noise": {"folder": "real", "files": ["rounded.csv"], "rounded_to_dps": 0.1},
                             "effects": [{"effect": "quantization", "lsb_dps": 0.1}]}},
   "cases": [{"effect": "start_up", "scenario": "rounded",
              "strong": {"amplitude_dps": 0.025, "settling_time_s": 1000000}}]})");
  const auto noise = read_recording(folder.path() / "real/rounded.csv").series;
  for (const auto& c : drawn_cases(check)) {
    const Series made = recorded(c, {1, 0});
    double moved = 0.0;
    for (int i = 0; i < samples; ++i) {
      const double steps = (made.gyro_dps[i] - noise.gyro_dps[i]) / 0.1;
      EXPECT_NEAR(steps, std::round(steps), 1e-9);
      moved += std::round(steps);
    }
    const double share = c.effects.empty() ? 0.0 : 0.25;
    EXPECT_NEAR(moved / samples, share, 4.0 * std::sqrt(share * (1.0 - share) / samples));
  }
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
  const auto check = read_blind_check(places::source() + "/experiments/studies/blind_check.json");
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
  for (const auto& effect : gap::catalogue())
    EXPECT_THAT(strengths[std::string(effect.id())], testing::ElementsAre("strong", "medium"))
        << effect.id();
  EXPECT_EQ(strengths.size(), gap::catalogue().size());
}

// Sets of every size are there in every scenario, and every recording is of a case that is scored.
TEST(BlindCheck, DrawsTheStudiesOfThisProject) {
  const std::filesystem::path source = places::source();
  for (const auto* name : {"sets", "hard", "lengths", "real_noise"}) {
    if (name == std::string("real_noise") && !exists(source / "../shared/recordings"))
      GTEST_SKIP() << "the recordings are not there";
    const auto file = fmt::format("experiments/studies/blind_check_{}.json", name);
    const auto check = read_blind_check((source / file).string());
    const auto cases = drawn_cases(check);
    std::set<std::size_t> sizes;
    for (const auto& c : cases) {
      sizes.insert(c.effects.size());
      for (const auto& effect : c.effects) {
        EXPECT_FALSE(holds(c.own, effect)) << file << ": " << effect;
        EXPECT_FALSE(holds(c.without, effect)) << file << ": " << effect;
      }
    }
    EXPECT_LT(cases.size(), 500u) << file << " takes longer than half an hour";
    if (name == std::string("sets")) {
      EXPECT_EQ(sizes, (std::set<std::size_t>{2, 3, 4, 5}));
    }
  }
}

class Scored : public testing::Test {
 protected:
  void diagnosed(BlindLabel label, const std::string& verdict,
                 const std::vector<std::string>& added, bool left_out = false,
                 const Json& gained = {}) {
    if (!left_out) {
      label.number = labels_.size();
      labels_.push_back(label);
    }
    Json found = {{"verdict", verdict},
                  {"verdict_set", added},
                  {"gap", {{"closed", added.empty() ? 0.0 : 0.9}, {"closed_interval", {0.5, 1.0}}}},
                  {"effects", Json::array()}};
    found["gap"]["log_score_gained"] = gained;
    for (const auto& effect : added)
      found["effects"].push_back({{"effect", effect}, {"inclusion", 0.9}});
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
  diagnosed(strong, "telegraph", {"telegraph", "outliers"}, false, 30.0);
  diagnosed(strong, "quantization", {"quantization"}, true, 27.6);
  diagnosed(strong, "none", {});
  diagnosed(none, "none", {});
  diagnosed(none, "telegraph", {"telegraph"});
  const BlindLabel pair{0, {"outliers", "vibration"}, "strong", 60.0};
  diagnosed(pair, "vibration", {"vibration", "outliers"});
  diagnosed(pair, "vibration", {"vibration"});
  labels_.push_back({labels_.size(), {"outliers"}, "strong", 60.0});  // never diagnosed
  auto all = tables();
  const auto& aims = all["aims"];
  using testing::StartsWith;
  EXPECT_THAT(text(aims, "strong", "named first"), StartsWith("33 % (1 of 3;"));
  EXPECT_THAT(text(aims, "strong", "gap seen"), StartsWith("67 % (2 of 3;"));
  EXPECT_THAT(text(aims, "strong", "in the set"), StartsWith("67 % (2 of 3;"));
  EXPECT_THAT(text(aims, "strong", "abstained without it"), StartsWith("50 % (1 of 2;"));
  EXPECT_THAT(text(aims, "none", "named first"), StartsWith("50 % (1 of 2;"));
  EXPECT_THAT(text(aims, "two effects, strong", "named first"), StartsWith("100 % (2 of 2;"));
  EXPECT_THAT(text(aims, "two effects, strong", "all named"), StartsWith("50 % (1 of 2;"));
  EXPECT_THAT(aims.notes, testing::Contains("1 recordings have no diagnosis"));
  EXPECT_EQ(text(all["effects"], "outliers", "taken for"), "none 1, telegraph 1");
  EXPECT_EQ(text(all["left_out"], "outliers", "verdicts"), "quantization 1, unknown 1");
  EXPECT_THAT(text(all["left_out"], "outliers", "unknown alone"), StartsWith("50 % (1 of 2;"));
  EXPECT_EQ(text(all["left_out"], "outliers", "log score lost by a name"), "2");
  EXPECT_THAT(text(all["calibration"], "0.8 to 0.95", "right"), StartsWith("71 % (5 of 7;"));
  EXPECT_THAT(all["calibration"].notes,
              testing::ElementsAre(StartsWith("Brier score of the effects that are given a "
                                              "probability: 0.24 (")));
  EXPECT_FALSE(all.contains("power"));  // one length
}

TEST_F(Scored, TellsHowMuchOfASetIsFound) {
  const BlindLabel three{0, {"outliers", "vibration", "hard_iron"}, "medium", 60.0};
  diagnosed(three, "outliers", {"outliers", "vibration", "hard_iron"});  // exact
  diagnosed(three, "outliers", {"outliers", "telegraph"});               // one of three, one wrong
  diagnosed(three, "none", {});
  auto all = tables();
  const auto& row = all["sets"].rows.front();
  EXPECT_EQ(std::get<std::string>(row[1]), "3");
  EXPECT_THAT(std::get<std::string>(row[4]), testing::StartsWith("0.44 ("));
  EXPECT_THAT(std::get<std::string>(row[5]), testing::StartsWith("0.80 ("));
  EXPECT_THAT(std::get<std::string>(row[6]), testing::StartsWith("33 % (1 of 3;"));
  EXPECT_EQ(text(all["set_effects"], "outliers", "named, else"), "2 of 3");
  EXPECT_EQ(text(all["set_effects"], "telegraph", "named where it is not"), "1 of 3");
  EXPECT_EQ(text(all["set_effects"], "vibration", "wrong names where it is missed"), "telegraph 1");
  EXPECT_THAT(text(all["closed"], "exact", "interval reaches 1"),
              testing::StartsWith("100 % (1 of 1;"));
}

TEST_F(Scored, PassesOverWhatASensorHasOfItsOwn) {
  BlindLabel label{0, {"outliers"}, "strong", 60.0};
  label.own = {"quantization"};
  diagnosed(label, "quantization", {"quantization", "outliers"});
  diagnosed(label, "quantization", {"quantization"});
  label.effects.clear();
  label.strength.clear();
  diagnosed(label, "quantization", {"quantization"});
  diagnosed(label, "unknown", {});
  diagnosed(label, "telegraph", {"telegraph"});
  auto all = tables();
  using testing::StartsWith;
  EXPECT_THAT(text(all["aims"], "strong", "named first"), StartsWith("50 % (1 of 2;"));
  EXPECT_THAT(text(all["aims"], "none", "named first"), StartsWith("67 % (2 of 3;"));
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

TEST(Seal, OpensWithItsKeyAlone) {
  const auto key = new_key(), other = new_key();
  EXPECT_EQ(key.size(), 64u);
  EXPECT_NE(key, other);
  const std::string text = "telegraph";
  auto seal = sealed(text, key);
  EXPECT_EQ(seal.find(text), std::string::npos);
  EXPECT_EQ(unsealed(seal, key, "here"), text);
  EXPECT_THROW(unsealed(seal, other, "here"), InputError);
  EXPECT_THROW(unsealed(seal, key.substr(1), "here"), InputError);
  EXPECT_THROW(unsealed(seal.substr(0, 10), key, "here"), InputError);
  seal.back() = static_cast<char>(seal.back() ^ 1);
  EXPECT_THROW(unsealed(seal, key, "here"), InputError);
}

TEST(BlindExport, IsAnsweredAndScoredByWhoHasTheKey) {
  TestFolder folder;
  auto check = check_of(folder, sets_json);
  check.sets.front().recordings = 1;
  const auto out = folder.path() / "out";
  const auto key = export_recordings(check, out);
  const auto contents = folder.contents();
  for (const auto& [name, text] : contents)
    if (name != "check.json" && name != "out/README.md") {
      EXPECT_EQ(text.find("outliers"), std::string::npos) << name;
    }
  EXPECT_TRUE(contents.contains("out/recordings/00003.csv.gz"));
  EXPECT_FALSE(contents.contains("out/recordings/00004.csv.gz"));
  EXPECT_EQ(Json::parse(contents.at("out/without.json"))["00000"], Json({"hard_iron"}));
  EXPECT_THROW(export_recordings(check, out), InputError);  // never over another's

  EXPECT_THROW(score_answers(out, folder.path() / "answers", key), InputError);
  folder.write("answers/00000.json", R"({"verdict": "unknown"})");
  EXPECT_THROW(score_answers(out, folder.path() / "answers", new_key()), InputError);
  const auto tables = score_answers(out, folder.path() / "answers", key);
  EXPECT_EQ(tables.front().name, "aims");
  EXPECT_THAT(tables.front().table.notes, testing::Contains("3 recordings have no diagnosis"));
  folder.write("answers/00001.json", R"({"verdict": "outlier"})");
  EXPECT_THROW(score_answers(out, folder.path() / "answers", key), InputError);
}

}  // namespace
}  // namespace gyrostat::gap::blind_check_test
