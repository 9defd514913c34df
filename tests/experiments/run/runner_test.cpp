#include <gyrostat/experiments/run/runner.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>

namespace gyrostat::runner_test {
namespace {

std::vector<Method> every_filter(ParameterSource source) {
  std::vector<Method> methods;
  for (const auto& id : filter_types().ids()) {
    Method method;
    method.id = method.filter = id;
    method.source = id == "oracle" ? ParameterSource::truth : source;
    methods.push_back(method);
  }
  return methods;
}

/// Small, with everything in it.
Cell busy_cell() {
  Cell cell;
  cell.name = "busy";
  cell.trials = 24;
  cell.scenario.sampling = {.duration_s = 60.0, .rate_hz = 10.0};
  cell.scenario.thermal_drift = {.a_dps_per_C = 0.002, .b_dps_s_per_C = 0.1, .c_dps = -0.05};
  cell.scenario.temperature = temperature::Cycle{.low_C = 20.0, .high_C = 50.0, .period_s = 60.0};
  cell.scenario.motion = motion::RateTable{};
  cell.scenario.effects = {effects::ThermalHysteresis{}, effects::Outliers{}};
  cell.scenario.compass.disturbances = {{.start_s = 20.0, .duration_s = 15.0}};
  cell.methods = every_filter(ParameterSource::calibration);
  return cell;
}

std::uint64_t bits(double v) { return std::bit_cast<std::uint64_t>(v); }

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double u, double v) { return bits(u) == bits(v); });
}

bool same_bits(const Outcome& a, const Outcome& b) { return same_bits(a.numbers(), b.numbers()); }

bool same_bits(const Record& a, const Record& b) {
  return a.calibration_converged == b.calibration_converged && same_bits(a.numbers, b.numbers);
}

bool same_bits(const CellResult& a, const CellResult& b) {
  return std::equal(a.trials.begin(), a.trials.end(), b.trials.begin(), b.trials.end(),
                    [](const auto& u, const auto& v) {
                      return u.has_value() == v.has_value() && (!u || same_bits(*u, *v));
                    });
}

CellResult run(const Cell& cell, int threads = 0, std::uint32_t lanes = default_lanes()) {
  RunOptions options;
  options.threads = threads;
  options.lanes = lanes;
  return run_cell(cell, 42, options);
}

TEST(Runner, OneThreadAndEightGiveTheSameBits) {
  for (const bool each_trial : {false, true}) {
    auto cell = busy_cell();
    cell.calibration.each_trial = each_trial;
    const auto one = run(cell, 1), eight = run(cell, 8);
    EXPECT_EQ(one.finished(), cell.trials);
    EXPECT_TRUE(same_bits(one, eight)) << "calibration each trial: " << each_trial;
  }
}

/// Every filter, packed or not; 23 trials fill packs of any size and leave one that is not full.
TEST(Runner, AnyNumberOfLanesGivesTheSameBits) {
  for (const bool each_trial : {false, true}) {
    auto cell = busy_cell();
    cell.trials = 23;
    cell.calibration.each_trial = each_trial;
    const auto one = run(cell, 1, 1);
    EXPECT_EQ(one.finished(), cell.trials);
    for (const std::uint32_t lanes : {2U, 4U, 8U, 16U})
      for (const int threads : {1, 4})
        EXPECT_TRUE(same_bits(one, run(cell, threads, lanes))) << lanes << ", " << threads;
  }
}

/// Without outliers these trials are never made as series but one at a time.
TEST(Runner, TrialsThatStayInLanesHaveTheBitsOfTheirSeries) {
  auto cell = busy_cell();
  cell.trials = 11;
  cell.scenario.effects.back() = effects::Quantization{.lsb_dps = 0.01};
  ASSERT_TRUE(prepare_cell(cell, 42, 1).conditions);
  ASSERT_FALSE(prepare_cell(busy_cell(), 42, 1).conditions);
  const auto one = run(cell, 1, 1);
  for (const std::uint32_t lanes : {2U, 4U, 8U, 16U})
    EXPECT_TRUE(same_bits(one, run(cell, 2, lanes))) << lanes;
}

TEST(Runner, RunningAgainGivesTheSameBits) {
  EXPECT_TRUE(same_bits(run(busy_cell()), run(busy_cell())));
}

TEST(Runner, AnotherSeedGivesOtherTrials) {
  EXPECT_FALSE(same_bits(run_cell(busy_cell(), 1, {}), run_cell(busy_cell(), 2, {})));
}

TEST(Runner, MoreTrialsLeaveTheFirstAsTheyWere) {
  auto cell = busy_cell();
  const auto few = run(cell);
  cell.trials *= 2;
  const auto many = run(cell);
  for (std::size_t trial = 0; trial < few.trials.size(); ++trial)
    EXPECT_TRUE(same_bits(*few.trials[trial], *many.trials[trial])) << trial;
}

TEST(Runner, AMethodsOutcomeDoesNotDependOnTheOthers) {
  const auto cell = busy_cell();
  const auto all = run(cell);
  auto alone = cell;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    alone.methods = {cell.methods[m]};
    const auto result = run(alone);
    for (std::size_t trial = 0; trial < result.trials.size(); ++trial)
      EXPECT_TRUE(same_bits(result.trials[trial]->of(0), all.trials[trial]->of(m)))
          << cell.methods[m].id << ", trial " << trial;
  }
}

/// Stops a run after a few trials; what is finished is what a whole run has there.
TEST(Runner, AStoppedRunHoldsWholeTrialsOfTheUninterruptedOne) {
  const auto cell = busy_cell();
  const auto whole = run(cell);
  for (const int threads : {1, 4}) {
    std::atomic<bool> stop{false};
    RunOptions options;
    options.threads = threads;
    options.lanes = 2;
    options.stop = &stop;
    options.progress = [&](std::size_t finished) {
      if (finished >= 5) stop = true;
    };
    const auto part = run_cell(cell, 42, options);
    EXPECT_GE(part.finished(), 5U);
    EXPECT_LE(part.finished(), 5U + options.lanes * static_cast<std::size_t>(threads));
    ASSERT_EQ(part.trials.size(), cell.trials);
    for (std::size_t trial = 0; trial < part.trials.size(); ++trial) {
      if (!part.trials[trial]) continue;
      EXPECT_TRUE(same_bits(*part.trials[trial], *whole.trials[trial])) << trial;
    }
  }
}

TEST(Runner, StoppedBeforeItStartsHasNoTrials) {
  const std::atomic<bool> stop{true};
  RunOptions options;
  options.stop = &stop;
  EXPECT_EQ(run_cell(busy_cell(), 42, options).finished(), 0U);
}

TEST(Runner, ProgressCountsEveryTrialOnce) {
  std::vector<std::atomic<int>> calls(busy_cell().trials + 1);
  RunOptions options;
  options.threads = 4;
  options.progress = [&](std::size_t finished) { ++calls.at(finished); };
  run_cell(busy_cell(), 42, options);
  EXPECT_EQ(calls[0], 0);
  EXPECT_TRUE(std::all_of(calls.begin() + 1, calls.end(), [](const auto& c) { return c == 1; }));
}

TEST(Runner, EveryStepOfEveryMethodIsCounted) {
  const auto result = run(busy_cell());
  for (const auto& record : result.trials)
    for (std::size_t m = 0; m < record->thrown.size(); ++m) {
      double steps = 0.0;
      for (std::size_t s = 0; s < status_names.size(); ++s)
        steps += record->of(m).steps(static_cast<Status>(s));
      EXPECT_EQ(steps, 600.0);
    }
}

std::size_t metric(const std::string& id) {
  const auto ids = metric_types().ids();
  return static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
}

/// Random error alone, at steady temperature and without motion: where the oracle's claim holds.
class RandomErrorCell : public testing::Test {
 protected:
  static constexpr std::size_t samples = 1000;
  static constexpr std::uint32_t trials = 300;

  static Cell cell() {
    Cell cell;
    cell.trials = trials;
    cell.scenario.sampling = {.duration_s = samples / 100.0, .rate_hz = 100.0};
    cell.scenario.random_error = {
        .phi = 0.9, .delta1_dps = 0.002, .delta2_dps = 0.0005, .measurement_noise_std_dps = 0.02};
    return cell;
  }

  static std::vector<double> values(const CellResult& result, std::size_t method, const char* id) {
    std::vector<double> out;
    for (const auto& record : result.trials) out.push_back(record->of(method).metric(metric(id)));
    return out;
  }
};

// No other method's mean bias_rmse lies below the oracle's, in the paired differences of the
// trials. Below -5 standard errors Student's t with 299 degrees falls at 5e-7, so that all 22
// comparisons together fail falsely at 1e-5 at most. The mean square, which the oracle minimises,
// is held to the same.
TEST_F(RandomErrorCell, TheOracleIsNeverBeaten) {
  for (const auto source : {ParameterSource::calibration, ParameterSource::truth}) {
    auto cell = RandomErrorCell::cell();
    cell.methods = every_filter(source);
    const auto result = run(cell);
    const auto oracle_at = static_cast<std::size_t>(
        std::find_if(cell.methods.begin(), cell.methods.end(),
                     [](const auto& method) { return method.id == "oracle"; }) -
        cell.methods.begin());
    const auto oracle = values(result, oracle_at, "bias_rmse");
    for (std::size_t m = 0; m < cell.methods.size(); ++m)
      for (const int power : {1, 2}) {
        const auto other = values(result, m, "bias_rmse");
        double sum = 0.0, squares = 0.0;
        for (std::size_t k = 0; k < other.size(); ++k) {
          const double difference = std::pow(other[k], power) - std::pow(oracle[k], power);
          sum += difference;
          squares += difference * difference;
        }
        const double mean = sum / trials;
        const double error =
            std::sqrt(std::max(0.0, squares / trials - mean * mean) / (trials - 1));
        EXPECT_GE(mean, -5.0 * error) << cell.methods[m].id << ", power " << power;
      }
  }
}

// Innovations of the optimal filter are white, so the mean of nu^2 / S over n of them is 1 with
// standard error sqrt(2 / n); at 5 of them each check fails falsely at 6e-7. NEES is correlated
// over time: its standard error is that of the trials' means.
TEST_F(RandomErrorCell, TheOracleIsConsistent) {
  auto cell = RandomErrorCell::cell();
  Method oracle;
  oracle.id = oracle.filter = "oracle";
  oracle.source = ParameterSource::truth;
  cell.methods = {oracle};
  const auto result = run(cell);
  double nis = 0.0, nees = 0.0, squares = 0.0;
  for (const double v : values(result, 0, "nis")) nis += v / trials;
  for (const double v : values(result, 0, "nees")) {
    nees += v / trials;
    squares += v * v / trials;
  }
  EXPECT_NEAR(nis, 1.0, 5.0 * std::sqrt(2.0 / (samples * static_cast<double>(trials))));
  EXPECT_NEAR(nees, 1.0, 5.0 * std::sqrt((squares - nees * nees) / trials));
}

/// With the truth about a gyro without moving average Kf is the optimal filter too.
TEST_F(RandomErrorCell, KfThatIsToldTheTruthEqualsTheOracleWhereDelta2IsZero) {
  auto cell = RandomErrorCell::cell();
  cell.trials = 20;
  cell.scenario.random_error.delta2_dps = 0.0;
  for (const char* id : {"kf", "kf_ma", "oracle"}) {
    Method method;
    method.id = method.filter = id;
    method.source = ParameterSource::truth;
    cell.methods.push_back(method);
  }
  const auto result = run(cell);
  const auto kf = values(result, 0, "bias_rmse"), exact = values(result, 1, "bias_rmse"),
             oracle = values(result, 2, "bias_rmse");
  for (std::size_t k = 0; k < kf.size(); ++k) {
    EXPECT_NEAR(kf[k], oracle[k], 1e-12);
    EXPECT_NEAR(exact[k], oracle[k], 1e-12);
  }
}

}  // namespace
}  // namespace gyrostat::runner_test
