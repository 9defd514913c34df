#include <gyrostat/experiments/study/design.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <gyrostat/experiments/findings/sensitivity.hpp>
#include <gyrostat/experiments/findings/sensitivity_words.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::design_test {
namespace {

using testing::HasSubstr;

Json study_json(const Json& design, std::uint32_t trials = 4) {
  return {{"seed", 3},
          {"cells",
           {{{"name", "d"},
             {"trials", trials},
             {"parameters_from", "truth"},
             {"scenario",
              {{"duration_s", 1}, {"rate_hz", 50}, {"effects", {{{"effect", "outliers"}}}}}},
             {"filters",
              {"kf", {{"id", "stf_1.05"}, {"filter", "stf"}, {"parameters", {{"adaptive", 0}}}}}},
             {"design", design}}}}};
}

Study study_of(const Json& design) { return parse_study(study_json(design), "s.json"); }

void expect_refused(const Json& design, const std::vector<std::string>& told) {
  try {
    (void)study_of(design);
    ADD_FAILURE() << "accepted: " << design.dump();
  } catch (const InputError& mistake) {
    for (const auto& part : told) EXPECT_THAT(mistake.what(), HasSubstr(part));
  }
}

const Json phi = {{"from", 0.2}, {"to", 0.8}};
const Json noise = {{"from", 0.001}, {"to", 0.1}, {"scale", "log"}};
const Json both = {{"scenario.random_error.phi", phi},
                   {"scenario.random_error.measurement_noise_std_dps", noise}};

TEST(Design, AGridIsTheSameUnderEitherKey) {
  const Json values = {{"scenario.random_error.phi", {0.1, 0.2}}, {"scenario.duration_s", {1, 2}}};
  auto json = study_json({{"kind", "grid"}, {"parameters", values}});
  const auto designed = parse_study(json, "s.json");
  json["cells"][0].erase("design");
  json["cells"][0]["grid"] = values;
  const auto gridded = parse_study(json, "s.json");
  ASSERT_EQ(designed.cells.size(), 4U);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(designed.cells[c].name, gridded.cells[c].name);
    EXPECT_EQ(designed.cells[c].scenario.random_error.phi,
              gridded.cells[c].scenario.random_error.phi);
  }
  EXPECT_EQ(designed.cells[3].name, "d[phi=0.2,duration_s=2]");
}

TEST(Design, AGridMayHaveLevels) {
  const auto study = study_of({{"kind", "grid"},
                               {"parameters",
                                {{"scenario.random_error.measurement_noise_std_dps",
                                  {{"from", 0.01}, {"to", 1}, {"scale", "log"}, {"levels", 3}}}}}});
  ASSERT_EQ(study.cells.size(), 3U);
  EXPECT_DOUBLE_EQ(study.cells[1].scenario.random_error.measurement_noise_std_dps, 0.1);
}

TEST(Design, AListIsItsPoints) {
  const auto study =
      study_of({{"kind", "list"},
                {"points",
                 {{{"scenario.random_error.phi", 0.5}},
                  {{"scenario.duration_s", 2}, {"scenario.random_error.phi", 0.1}}}}});
  ASSERT_EQ(study.cells.size(), 2U);
  EXPECT_EQ(study.cells[0].name, "d[phi=0.5]");
  EXPECT_EQ(study.cells[0].scenario.sampling.duration_s, 1.0);
  EXPECT_EQ(study.cells[1].scenario.sampling.duration_s, 2.0);
}

TEST(Design, PointsLieWithinTheSpanOnItsScale) {
  for (const char* kind : {"latin_hypercube", "sobol"}) {
    const auto study = study_of({{"kind", kind}, {"points", 64}, {"parameters", both}});
    ASSERT_EQ(study.cells.size(), 64U);
    int below = 0;
    for (const auto& cell : study.cells) {
      const auto& error = cell.scenario.random_error;
      EXPECT_TRUE(error.phi >= 0.2 && error.phi <= 0.8);
      EXPECT_TRUE(error.measurement_noise_std_dps >= 0.001 &&
                  error.measurement_noise_std_dps <= 0.1);
      below += error.measurement_noise_std_dps < 0.01;  // the middle of the logarithm
    }
    EXPECT_EQ(below, 32) << kind;
  }
}

TEST(Design, OneAtATimeGoesFromTheBaseToBothEnds) {
  const auto study = study_of({{"kind", "one_at_a_time"}, {"parameters", both}});
  ASSERT_EQ(study.cells.size(), 5U);
  EXPECT_EQ(study.cells[0].name, "d[base]");
  EXPECT_EQ(study.cells[0].scenario.random_error.phi, 0.3);  // the default, to the bit
  EXPECT_EQ(study.cells[2].name, "d[phi=0.8]");
  EXPECT_EQ(study.cells[2].scenario.random_error.phi, 0.8);
  EXPECT_EQ(study.cells[2].scenario.random_error.measurement_noise_std_dps, 0.05);
}

TEST(Design, NamesFiltersByIdAndEffectsByName) {
  const auto study =
      study_of({{"kind", "latin_hypercube"},
                {"points", 3},
                {"parameters",
                 {{"filters.stf_1.05.parameters.fading_factor", {{"from", 1}, {"to", 2}}},
                  {"filters.kf.parameters.phi", phi},
                  {"scenario.effects.outliers.std_dps", {{"from", 0.1}, {"to", 1}}}}}});
  const auto& cell = study.cells[1];
  EXPECT_GE(cell.methods[1].overrides.at("fading_factor"), 1.0);
  EXPECT_EQ(cell.methods[1].overrides.at("adaptive"), 0.0);
  EXPECT_GE(cell.methods[0].overrides.at("phi"), 0.2);
  EXPECT_EQ(study.designs[0].parameters[2].unit, "dps");
}

TEST(Design, AnEndThatIsNotGivenIsThatOfTheParameter) {
  const auto study =
      study_of({{"kind", "grid"},
                {"parameters", {{"filters.stf_1.05.parameters.forgetting", {{"levels", 2}}}}}});
  EXPECT_EQ(study.cells[0].methods[1].overrides.at("forgetting"), 0.0);
  EXPECT_EQ(study.cells[1].methods[1].overrides.at("forgetting"), 1.0);
}

TEST(Design, NamesEveryMistakeInOneLine) {
  const auto of = [](const std::string& path, const Json& span) -> Json {
    return {{"kind", "saltelli"}, {"parameters", {{path, span}}}};
  };
  expect_refused(of("scenario.random_error.phy", phi),
                 {"scenario.random_error.phi", "did you mean"});
  expect_refused(of("filters.kff.parameters.phi", phi),
                 {"did you mean 'filters.kf.parameters.phi'"});
  expect_refused(of("scenario.random_error.phi", {{"to", 0.5}}), {"from", "missing", "(-1, 1)"});
  expect_refused(of("scenario.random_error.delta1_dps", {{"from", 0}}),
                 {"\"to\" is missing", "[0, inf)", "dps"});
  expect_refused(of("scenario.random_error.phi", {{"from", 0.1}, {"to", 1.5}}),
                 {"phi.to", "1.5", "(-1, 1)"});
  expect_refused(of("scenario.random_error.phi", {{"from", 0.5}, {"to", 0.1}}),
                 {"0.5", "not below"});
  expect_refused(of("scenario.random_error.phi", {{"from", -0.5}, {"to", 0.1}, {"scale", "log"}}),
                 {"-0.5", "logarithm"});
  expect_refused(of("scenario.random_error.phi", {{"from", 0.1}, {"to", 0.5}, {"scale", "lg"}}),
                 {"scale", "did you mean 'log'"});
  expect_refused(of("scenario.random_error.phi", {{"form", 0.1}, {"to", 0.5}, {"from", 0.2}}),
                 {"form", "did you mean 'from'"});
  expect_refused({{"kind", "saltely"}, {"parameters", both}},
                 {"design.kind", "did you mean 'saltelli'"});
  expect_refused({{"type", "saltelli"}, {"row", 64}, {"parameters", both}},
                 {"\"kind\" is missing; known: grid, list", "'type'", "did you mean 'rows'"});
  expect_refused({{"kind", "saltelli"}, {"points", 3}, {"parameters", both}},
                 {"points", "did you mean"});
  expect_refused({{"kind", "saltelli"}}, {"parameters"});
  expect_refused({{"kind", "saltelli"}, {"rows", 0}, {"parameters", both}}, {"rows", "[1, "});
  expect_refused({{"kind", "morris"}, {"levels", 5}, {"parameters", both}},
                 {"levels", "5", "even"});
  expect_refused({{"kind", "list"}, {"points", Json::array()}}, {"points"});
  expect_refused({{"kind", "one_at_a_time"}, {"parameters", {{"filters.kf.parameters.phi", phi}}}},
                 {"base", "calibration"});
  expect_refused("saltelli", {"cells[0].design", "object"});
}

TEST(Design, ShardsMergeToTheBytesOfTheSingleRun) {
  const TestFolder folder;
  folder.write("s.json",
               study_json({{"kind", "saltelli"}, {"rows", 4}, {"parameters", both}}).dump());
  const auto whole = run_program(folder, {"run", "s.json"});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("d: Sobol' indices of bias_rmse"));
  EXPECT_THAT(whole.out, HasSubstr("trial noise"));
  EXPECT_THAT(whole.out, HasSubstr("row_4_phi"));
  EXPECT_THAT(whole.out, testing::Not(HasSubstr("compensated rate error")));
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(run_program(folder, {"run", "s.json", "--shard", shard, "--out",
                                   std::string("half_") + shard[0]})
                  .exit_code,
              0);
  ASSERT_EQ(run_program(folder, {"merge", "merged", "half_1", "half_2"}).exit_code, 0);
  ASSERT_EQ(run_program(folder, {"run", "s.json", "--out", "merged"}).exit_code, 0);
  for (const char* file : {"tables.json", "tables.md", "outcomes.csv.gz"})
    EXPECT_EQ(folder.read(std::string("merged/") + file),
              folder.read(std::string("runs/s/") + file))
        << file;
}

TEST(Design, ItsStudyIsReadBackFromTheStore) {
  const TestFolder folder;
  folder.write("s.json",
               study_json({{"kind", "morris"}, {"trajectories", 5}, {"parameters", both}}).dump());
  ASSERT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
  const Store store = Store::open(folder.path() / "runs/s");
  const auto study = stored_study(store);
  ASSERT_EQ(study.designs.size(), 1U);
  EXPECT_EQ(
      study.designs[0].points,
      study_of({{"kind", "morris"}, {"trajectories", 5}, {"parameters", both}}).designs[0].points);
  const auto found = sensitivities(study, store);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].elementary_effects.size(), 2U);
  EXPECT_EQ(found[0].means.size(), 15U);
  EXPECT_GT(found[0].elementary_effects[1].mu_star.value, 0.0);
}

TEST(SensitivityVerb, PrintsTablesInEveryFormatAndNamesMistakes) {
  const TestFolder folder;
  folder.write("s.json", study_json({{"kind", "one_at_a_time"}, {"parameters", both}}).dump());
  ASSERT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
  for (const char* format : {"text", "md", "csv", "json", "latex"}) {
    const auto ended = run_program(folder, {"sensitivity", "runs/s", "--format", format});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("elasticity"));
  }
  EXPECT_THAT(
      run_program(folder, {"sensitivity", "runs/s", "--metric", "heading_end", "--method", "kf"})
          .out,
      HasSubstr("elasticities of heading_end"));
  EXPECT_THAT(run_program(folder, {"sensitivity", "runs/s", "--points"}).out, HasSubstr("base"));
  const auto metric = run_program(folder, {"sensitivity", "runs/s", "--metric", "bias_rms"});
  EXPECT_EQ(metric.exit_code, 2);
  EXPECT_THAT(metric.err, HasSubstr("did you mean 'bias_rmse'"));
  EXPECT_THAT(run_program(folder, {"sensitivity", "runs/s", "--method", "fk"}).err,
              HasSubstr("did you mean 'kf'"));
}

TEST(Plan, MeasuresAFewPointsOfADesignAndSaysSo) {
  const TestFolder folder;
  folder.write("s.json",
               study_json({{"kind", "saltelli"}, {"rows", 250}, {"parameters", both}}).dump());
  const auto ended = run_program(folder, {"plan", "s.json", "--pilot", "0.1"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("d (saltelli)"));
  EXPECT_THAT(ended.out, HasSubstr("measured at 3 of its 1000 points"));
}

TEST(Surrogate, IsWrittenAsAFunctionThatNeedsNothingElse) {
  const TestFolder folder;
  auto study = study_json({{"kind", "surrogate"}, {"rows", 12}, {"parameters", both}});
  folder.write("s.json", study.dump());
  ASSERT_EQ(run_program(folder, {"run", "s.json"}).exit_code, 0);
  const auto told =
      run_program(folder, {"sensitivity", "runs/s", "--json", "f.json", "--format", "md"});
  ASSERT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("of the variance unexplained"));
  const auto json = Json::parse(folder.read("f.json"));
  ASSERT_FALSE(json.at("surrogates").empty());
  for (const auto& s : json.at("surrogates")) {
    ASSERT_EQ(s.at("parameters").size(), both.size());
    EXPECT_EQ(s.at("parameters")[0].at("first_order").size(), 3U);
    EXPECT_EQ(s.at("points"), 12 * (both.size() + 2));
    for (const auto& term : s.at("terms")) EXPECT_EQ(term.at("degrees").size(), both.size());
    EXPECT_GT(s.at("terms")[0].at("coefficient"), 0.0);  // the mean of an error over the cube
  }
  folder.write("t.json",
               study_json({{"kind", "saltelli"}, {"rows", 2}, {"parameters", both}}).dump());
  ASSERT_EQ(run_program(folder, {"run", "t.json"}).exit_code, 0);
  const auto none = run_program(folder, {"sensitivity", "runs/t", "--json", "none.json"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("no design of kind surrogate"));
}

TEST(SensitivitySentence, NamesWhatMattersMost) {
  Sensitivity s{.method = "kf", .metric = "bias_rmse", .unit = "dps"};
  EXPECT_EQ(sensitivity_sentence(s), "");
  s.elasticities = {{"phi", {0.2, 0.1, 0.3}}, {"noise", {-0.9, -1.0, -0.8}}};
  EXPECT_EQ(sensitivity_sentence(s),
            "kf: noise matters most to bias_rmse (elasticity -0.9, -1 to -0.8), then phi (0.2, 0.1 "
            "to 0.3)");
  s.elasticities.clear();
  s.elementary_effects = {{"phi", {0.2, 0.1, 0.3}, {}}, {"noise", {0.1, 0.0, 0.3}, {}}};
  EXPECT_EQ(sensitivity_sentence(s),
            "kf: phi matters most to bias_rmse (mu* 0.2, 0.1 to 0.3 dps); the others' effects are "
            "not told from none");
  s.elementary_effects.clear();
  s.indices = {{"phi", {}, {0.2, 0.0, 0.9}}, {"noise", {}, {no_value, no_value, no_value}}};
  EXPECT_EQ(sensitivity_sentence(s), "kf: no parameter's effect on bias_rmse is told from none");
}

TEST(SurrogateVerdict, SaysWhetherItIsTrustedAndWhatStandsInItsPlace) {
  Sensitivity s{.method = "kf", .surrogate = Surrogate{}};
  EXPECT_THAT(surrogate_verdict(s), HasSubstr("too few rows"));
  s.surrogate->unexplained = {0.02, 0.01, 0.03};
  s.surrogate->is_trusted = true;
  EXPECT_THAT(
      surrogate_verdict(s),
      HasSubstr("kf: a chaos of 0 terms leaves 2 % (up to 3 %) of the variance unexplained, "
                "10 % allowed: it is trusted"));
  s.surrogate->unexplained = {0.2, no_value, no_value};
  s.surrogate->is_trusted = false;
  EXPECT_THAT(surrogate_verdict(s), HasSubstr("leaves 20 % of the variance unexplained, 10 % "
                                              "allowed: it is not trusted, and the indices are "
                                              "those of the rows alone"));
}

}  // namespace
}  // namespace gyrostat::design_test
