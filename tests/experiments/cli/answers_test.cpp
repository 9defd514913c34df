// What verbs say first, what they leave to who asks, and what they hand to programs.

#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/tests/analysis/simulated_random_error.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::answers_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A finished run of a design of 32 points, and of a study of one cell.
class Answers : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TestFolder;
    folder_->write("points.json", R"({"cells": [{"name": "sweep", "trials": 3,
      "parameters_from": "truth", "scenario": {"duration_s": 2, "rate_hz": 50},
      "filters": ["none", "kf", "stf"], "design": {"kind": "sobol", "points": 32, "parameters":
        {"scenario.random_error.phi": {"from": 0.1, "to": 0.9}}}}]})");
    folder_->write("one.json", R"({"cells": [{"name": "c", "trials": 60, "parameters_from": "truth",
      "scenario": {"duration_s": 4, "rate_hz": 50}, "filters": ["none", "kf", "stf"]}]})");
    run("points.json");
    one_ = run("one.json");
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static Ended run(const std::string& study) {
    auto ended = run_program(*folder_, {"run", study});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended;
  }

  static inline TestFolder* folder_ = nullptr;
  static inline Ended one_;
};

TEST_F(Answers, StandAboveTheTables) {
  EXPECT_THAT(one_.out, StartsWith("kf has the smallest bias estimation error"));
  EXPECT_THAT(run_program(*folder_, {"rank", "runs/one"}).out,
              StartsWith("kf has the smallest bias estimation error"));
  EXPECT_THAT(run_program(*folder_, {"status", "runs/one"}).out,
              StartsWith("one is complete: 60 trials, none failed.\n\n"));
  EXPECT_TRUE(json::accept(run_program(*folder_, {"rank", "runs/one", "--format", "json"}).out));
}

TEST_F(Answers, ArePlainTextWhereThereIsNoTerminal) {
  EXPECT_THAT(one_.out, Not(HasSubstr("\x1b")));
}

TEST_F(Answers, OfADesignAreCountedAndItsPointsLeftToWhoAsks) {
  const auto short_one = run_program(*folder_, {"rank", "runs/points"});
  EXPECT_THAT(short_one.out, StartsWith("By bias_rmse, kf is best in "));
  EXPECT_THAT(short_one.out, HasSubstr(" of 32 cells"));
  EXPECT_THAT(short_one.out, Not(HasSubstr("ranking by")));
  EXPECT_THAT(short_one.err, HasSubstr("--points ranks 32 points of designs"));
  EXPECT_THAT(run_program(*folder_, {"rank", "runs/points", "--points"}).out,
              HasSubstr("sweep[point_32]: ranking by bias_rmse"));
  EXPECT_THAT(run_program(*folder_, {"rank", "runs/points", "--cell", "sweep[point_3]"}).out,
              HasSubstr("sweep[point_3]: ranking by bias_rmse"));
}

TEST_F(Answers, ReplayTakesTheFolderOfARun) {
  const auto by_name = run_program(*folder_, {"replay", "one:c:3:kf"});
  const auto by_folder = run_program(*folder_, {"replay", "runs/one:c:3:kf"});
  ASSERT_EQ(by_folder.exit_code, 0) << by_folder.err;
  EXPECT_THAT(by_folder.out, HasSubstr("the same outcome, to the bit, as in the store"));
  EXPECT_EQ(by_folder.out.substr(by_folder.out.find('\n')),
            by_name.out.substr(by_name.out.find('\n')));
  EXPECT_THAT(run_program(*folder_, {"replay", "runs/two:c:3:kf"}).err,
              StartsWith("gyrostat: runs/two: there is no run here"));
}

/// The recording of a walk, at 100 Hz.
std::string recording(const Arima111<double>& model, std::size_t samples, const Noise& noise) {
  std::string text = "t_s,gyro_dps\n";
  std::size_t k = 0;
  for (const double rate : simulated(model, samples, noise))
    text += fmt::format("{:.2f},{}\n", 0.01 * static_cast<double>(k++), rate);
  return text;
}

TEST(FitAnswers, WritesValuesUnderTheirNamesAndPictures) {
  const TestFolder folder;
  folder.write("r.csv", recording({0.9, 0.02, 0.004, 0.02}, 2000, Noise{1, 0}));
  const auto ended = run_program(
      folder, {"fit", "r.csv", "--json", "fit.json", "--svg", "a.svg", "--html", "a.html"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto fit = json::parse(folder.read("fit.json"));
  EXPECT_EQ(fit["samples"], 2000);
  EXPECT_EQ(fit["likelihood"]["converged"], true);
  const auto& phi = fit["likelihood"]["phi"];
  EXPECT_LT(phi["from"], phi["value"]);
  EXPECT_LT(phi["value"], phi["to"]);
  EXPECT_EQ(fit["likelihood"]["delta1_dps"]["unit"], "dps");
  EXPECT_TRUE(fit["moments"]["phi"]["from"].is_null());
  EXPECT_GT(fit["allan"]["angle_random_walk_dps_per_sqrt_hz"]["to"], 0.0);
  EXPECT_THAT(folder.read("a.svg"), StartsWith("<svg"));
  EXPECT_THAT(folder.read("a.html"), HasSubstr("angle random walk"));
  ASSERT_EQ(run_program(folder, {"allan", "r.csv", "--svg", "b.svg"}).exit_code, 0);
  EXPECT_THAT(folder.read("b.svg"), HasSubstr("Allan deviation"));
  EXPECT_EQ(run_program(folder, {"allan", "r.csv", "--svg", "r.csv"}).exit_code, 2);
}

// In white noise alone there is no phi to be told: about a quarter of such fits hold it at 0.
TEST(FitAnswers, SaysWhatCannotBeToldRatherThanInfinity) {
  const TestFolder folder;
  int untold = 0;
  for (std::uint64_t seed = 1; seed <= 20 && untold == 0; ++seed) {
    folder.write("r.csv", recording({0.0, 0.0, 0.0, 0.1}, 600, Noise{seed, 0}));
    const auto out = run_program(folder, {"fit", "r.csv", "--method", "likelihood"}).out;
    EXPECT_THAT(out, Not(HasSubstr(" inf"))) << out;
    untold += out.find("cannot be told\n") != out.npos;
  }
  EXPECT_GT(untold, 0);
}

// A walk of long memory far below white noise: phi = -0.9 is as likely as the fit's 0.96.
TEST(FitAnswers, SaysThatTheLikelihoodHasSeveralMaxima) {
  const TestFolder folder;
  folder.write("r.csv", recording({0.95, 2e-3, 1.5e-3, 0.2}, 6000, Noise{77, 1}));
  const auto ended = run_program(folder, {"fit", "r.csv", "--method", "likelihood", "--json", "f"});
  EXPECT_THAT(ended.out, HasSubstr("the likelihood has several maxima"));
  const auto phi = json::parse(folder.read("f"))["likelihood"]["phi"];
  EXPECT_GT(phi["value"], 0.9);
  EXPECT_LT(phi["from"], -0.9);
  EXPECT_TRUE(phi["standard_error"].is_null());
}

}  // namespace
}  // namespace gyrostat::answers_test
