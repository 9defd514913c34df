// Sensors that are drawn from a fleet: by which law, and the same ones whoever asks.

#include <gyrostat/experiments/study/fleet.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/shard.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/experiments/study/fleet_reading.hpp>
#include <gyrostat/generators/effects/noise_averaging.hpp>
#include <gyrostat/generators/effects/vibration.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::fleet_test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr std::uint32_t sensors = 4000;
/// Kolmogorov's: 2 exp(-2 x^2) is 1e-6 at 2.69, where a true law fails.
constexpr double once_in_a_million = 2.69;

FleetUnit unit(const std::string& name, const Arima111<double>& random_error, double bias_dps = 0.0,
               std::vector<Effect> effects = {}) {
  FleetUnit u{.name = name, .scenario = {}, .errors = {}};
  u.scenario.sampling = {.duration_s = 60, .rate_hz = 50};
  u.scenario.random_error = random_error;
  u.scenario.thermal_drift.c_dps = bias_dps;
  u.scenario.effects = std::move(effects);
  return u;
}

const std::vector<double> noises_dps = {0.050, 0.061, 0.047, 0.055, 0.052};
const std::vector<double> biases_dps = {0.3, -0.8, 1.1, 0.2, -0.1};

std::vector<FleetUnit> five() {
  std::vector<FleetUnit> units;
  for (std::size_t u = 0; u < 5; ++u)
    units.push_back(unit(std::to_string(u),
                         {.phi = 0.5 + 0.02 * static_cast<double>(u % 3),
                          .delta1_dps = 0.04 * noises_dps[u],
                          .delta2_dps = 0.01 * noises_dps[u],
                          .measurement_noise_std_dps = noises_dps[u]},
                         biases_dps[u]));
  return units;
}

std::vector<double> drawn(const Fleet& fleet, const std::function<double(const Scenario&)>& of) {
  std::vector<double> values;
  Scenario sensor;
  for (std::uint32_t trial = 0; trial < sensors; ++trial) {
    fleet.draw(fleet.nominal(), {.seed = 7, .trial = trial}, sensor);
    values.push_back(of(sensor));
  }
  return values;
}

/// Kolmogorov's distance of values from a law, times the root of their number.
double distance(std::vector<double> values, const std::function<double(double)>& below) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double p = below(values[i]), k = static_cast<double>(i);
    most = std::max({most, std::abs(p - k / n), std::abs(p - (k + 1.0) / n)});
  }
  return most * std::sqrt(n);
}

struct Moments {
  double n = 0.0, mean = 0.0, std = 0.0;
  explicit Moments(const std::vector<double>& values) : n(static_cast<double>(values.size())) {
    for (const double v : values) mean += v / n;
    for (const double v : values) std += (v - mean) * (v - mean) / (n - 1.0);
    std = std::sqrt(std);
  }
  /// P(next value < x), were they of a normal law.
  double next_below(double x) const {
    return student_t_upper_tail(-(x - mean) / (std * std::sqrt(1.0 + 1.0 / n)), n - 1.0);
  }
};

double log_noise(const Scenario& s) { return std::log(s.random_error.measurement_noise_std_dps); }
double bias(const Scenario& s) { return s.thermal_drift.c_dps; }

std::vector<double> logarithms(std::vector<double> values) {
  for (auto& v : values) v = std::log(v);
  return values;
}

// ---------------------------------------------------------------- the law

TEST(Fleet, TheNextSensorIsStudentsAroundTheMean) {
  const Fleet fleet(five(), "test");
  const Moments noise(logarithms(noises_dps)), biases(biases_dps);
  EXPECT_LT(distance(drawn(fleet, log_noise), [&](double x) { return noise.next_below(x); }),
            once_in_a_million);
  EXPECT_LT(distance(drawn(fleet, bias), [&](double x) { return biases.next_below(x); }),
            once_in_a_million);
  // And the test would see the mean's error left out, and a normal law in its place.
  EXPECT_GT(
      distance(drawn(fleet, bias),
               [&](double x) { return 1.0 - normal_upper_tail((x - biases.mean) / biases.std); }),
      once_in_a_million);
}

TEST(Fleet, TwoUnitsTellALawWithoutMoments) {
  const Arima111<double> same;
  const Fleet fleet({unit("a", same, 0.1), unit("b", same, 0.3)}, "test");
  const Moments biases({0.1, 0.3});
  EXPECT_LT(distance(drawn(fleet, bias), [&](double x) { return biases.next_below(x); }),
            once_in_a_million);
  const auto phis = drawn(fleet, [](const Scenario& s) { return s.random_error.phi; });
  for (const double phi : phis) ASSERT_EQ(phi, same.phi) << "what is equal in all is constant";
}

/// With equal errors e, Paule and Mandel's spread is sqrt(s^2 - e^2), and the mean's error s / sqrt
/// n.
TEST(Fleet, WhatErrorsExplainIsNoSpread) {
  const std::vector<double> stds = {1.00, 1.02, 1.05, 0.97};
  constexpr double error = 0.02;  // of the logarithm
  std::vector<FleetUnit> units;
  for (const double std_dps : stds) {
    units.push_back(unit("u", {}, 0.0, {effects::Vibration{.std_dps = std_dps}}));
    units.back().errors = {
        std::vector<double>(units.back().scenario.effects[0].fields().size(), no_value)};
    units.back().errors[0][0] = error * std_dps;
  }
  const Fleet fleet(units, "test");
  const Moments logs(logarithms(stds));
  ASSERT_GT(logs.std, error);
  const double scale =
      std::sqrt(logs.std * logs.std - error * error + logs.std * logs.std / logs.n);
  const auto values =
      drawn(fleet, [](const Scenario& s) { return std::log(s.effects.at(0).value(0)); });
  EXPECT_LT(distance(values,
                     [&](double x) {
                       return student_t_upper_tail(-(x - logs.mean) / scale, logs.n - 1.0);
                     }),
            once_in_a_million);
}

TEST(Fleet, WhatGoesTogetherInTheUnitsDoesSoInTheDraw) {
  const Fleet fleet(five(), "test");
  const auto ratio = drawn(fleet, [](const Scenario& s) {
    return s.random_error.delta1_dps / s.random_error.measurement_noise_std_dps;
  });
  const auto theta = drawn(fleet, [](const Scenario& s) { return s.random_error.theta(); });
  for (const double r : ratio) ASSERT_NEAR(r, 0.04, 1e-9);
  for (const double t : theta) ASSERT_NEAR(t, 0.25, 1e-9);
}

/// Standard error .0063 at a third: five of them fail once in a million.
TEST(Fleet, EffectsAreThoseOfOneUnit) {
  const Arima111<double> same;
  const effects::Vibration vibration;
  const effects::NoiseAveraging once{.length = 1.1, .stages = 1}, twice{.length = 0.7, .stages = 2};
  const Fleet fleet({unit("a", same, 0, {vibration, once}), unit("b", same, 0, {twice}),
                     unit("c", same, 0, {vibration})},
                    "test");
  const auto share = [&](std::size_t number, const std::string& first) {
    const auto are = drawn(fleet, [&](const Scenario& s) {
      return s.effects.size() == number && s.effects[0].id() == first ? 1.0 : 0.0;
    });
    return Moments(are).mean;
  };
  const double tolerance = 5 * std::sqrt(2.0 / 9.0 / sensors);
  EXPECT_NEAR(share(2, "vibration"), 1.0 / 3.0, tolerance);
  EXPECT_NEAR(share(1, "noise_averaging"), 1.0 / 3.0, tolerance);
  EXPECT_NEAR(share(1, "vibration"), 1.0 / 3.0, tolerance);
  ASSERT_EQ(fleet.nominal().effects.size(), 1);
  EXPECT_EQ(fleet.nominal().effects[0].id(), "vibration");
  Scenario sensor;
  for (std::uint32_t trial = 0; trial < 100; ++trial) {
    fleet.draw(fleet.nominal(), {1, trial}, sensor);
    for (const auto& effect : sensor.effects)
      if (effect.id() == "noise_averaging") {
        const bool is_once = effect.value(1) == 1.0;
        EXPECT_EQ(effect.value(0), is_once ? 1.1 : 0.7) << "what one unit has alone is kept";
      }
  }
}

TEST(Fleet, WhatLiesBeyondTheRangeIsDrawnAgain) {
  std::vector<double> phis = {0.5, 0.8, 0.95, 0.6};
  std::vector<FleetUnit> units;
  for (const double phi : phis) units.push_back(unit("u", {.phi = phi}));
  Fleet fleet(units, "test");
  const Moments m(phis);
  const double below = m.next_below(-1.0), within = m.next_below(1.0) - below;
  const auto values = drawn(fleet, [](const Scenario& s) { return s.random_error.phi; });
  EXPECT_LT(distance(values, [&](double x) { return (m.next_below(x) - below) / within; }),
            once_in_a_million);
  auto nominal = fleet.nominal();
  fleet.settle({}, nominal, "test");
  // 400 draws for each of four units, alike: standard error of 400.
  EXPECT_NEAR(fleet.redrawn(), 1.0 - within, 5 * std::sqrt(within * (1.0 - within) / 400));
}

TEST(Fleet, WhatTheStudyStatesIsNotDrawn) {
  Fleet fleet(five(), "test");
  auto nominal = fleet.nominal();
  nominal.random_error.delta1_dps = 0.01;
  nominal.thermal_drift.c_dps = 0.0;
  fleet.settle({"delta1_dps", "c_dps", "effects"}, nominal, "test");
  EXPECT_NEAR(nominal.random_error.delta2_dps, 0.0025, 1e-9) << "theta is still the fleet's";
  Scenario sensor;
  for (std::uint32_t trial = 0; trial < 50; ++trial) {
    fleet.draw(nominal, {1, trial}, sensor);
    EXPECT_EQ(sensor.random_error.delta1_dps, 0.01);
    EXPECT_NEAR(sensor.random_error.delta2_dps, 0.0025, 1e-9);
    EXPECT_EQ(sensor.thermal_drift.c_dps, 0.0);
    EXPECT_NE(sensor.random_error.measurement_noise_std_dps,
              nominal.random_error.measurement_noise_std_dps);
  }
}

/// A mixture of trials' noise is a draw of the same law: what a search for failures relies on.
TEST(Fleet, MixturesOfTrialsAreOfTheSameLaw) {
  const Fleet fleet(five(), "test");
  const Moments biases(biases_dps);
  std::vector<double> values;
  Scenario sensor;
  for (std::uint32_t trial = 0; trial < sensors; ++trial) {
    const NoiseShare shares[] = {{2 * trial, 0.6}, {2 * trial + 1, 0.8}};
    fleet.draw(fleet.nominal(), {.seed = 9, .trial = 0, .shares = shares}, sensor);
    values.push_back(bias(sensor));
  }
  EXPECT_LT(distance(values, [&](double x) { return biases.next_below(x); }), once_in_a_million);
}

// ---------------------------------------------------------------- in a study

Json fleet_json(const std::vector<FleetUnit>& units) {
  Json json = {{"each", Json::array()}, {"shared", Json::array()}};
  for (const auto& u : units) {
    Json random_error, drift, effects = Json::array();
    for (const auto& f : Arima111<double>::fields())
      random_error[std::string(f.name)] = u.scenario.random_error.*(f.member);
    for (const auto& f : ThermalDrift<double>::fields())
      drift[std::string(f.name)] = u.scenario.thermal_drift.*(f.member);
    for (const auto& effect : u.scenario.effects) {
      Json one = {{"effect", effect.id()}};
      for (std::size_t f = 0; f < effect.fields().size(); ++f)
        one[std::string(effect.fields()[f].name)] = effect.value(f);
      effects.push_back(one);
    }
    json["each"].push_back({{"sensor", u.name},
                            {"diagnosis",
                             {{"effects", Json::array()},
                              {"enriched",
                               {{"duration_s", 60},
                                {"rate_hz", u.scenario.sampling.rate_hz},
                                {"random_error", random_error},
                                {"thermal_drift", drift},
                                {"effects", effects}}}}}});
  }
  return json;
}

Json next_sensor() {
  return {{"seed", 5},
          {"cells",
           {{{"name", "next"},
             {"trials", 24},
             {"scenario", {{"duration_s", 5}, {"from_fleet", {{"file", "fleet.json"}}}}},
             {"filters",
              {"none",
               "kf",
               {{"id", "kf_own"}, {"filter", "kf"}, {"parameters_from", "truth"}},
               "sr_ukf",
               "oracle"}}}}}};
}

Study study_of(const TestFolder& folder, const Json& json) {
  folder.write("study.json", json.dump());
  return read_study((folder.path() / "study.json").string());
}

std::vector<FleetUnit> five_with_effects() {
  auto units = five();
  units[1].scenario.effects = {effects::Vibration{.std_dps = 0.02}};
  units[3].scenario.effects = {effects::Vibration{.std_dps = 0.03}};
  return units;
}

std::vector<std::vector<double>> numbers(const Cell& cell, const RunOptions& options,
                                         const Shard& shard = {}) {
  std::vector<std::vector<double>> all(cell.trials);
  const auto prepared = prepare_cell(cell, 5, options.threads);
  run_trials(
      prepared, 5, options, [&](std::uint32_t trial) { return shard.owns(trial); },
      [&](std::uint32_t trial, Record&& record) { all[trial] = std::move(record.numbers); });
  return all;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double u, double v) { return u == v || (is_missing(u) && is_missing(v)); });
}

TEST(FromFleet, ThreadsLanesAndShardsChangeNoBit) {
  const TestFolder folder;
  folder.write("fleet.json", fleet_json(five_with_effects()).dump());
  for (const bool each_trial : {false, true}) {
    auto cell = study_of(folder, next_sensor()).cells[0];
    cell.calibration.each_trial = each_trial;
    RunOptions one;
    one.threads = 1;
    one.lanes = 1;
    const auto expected = numbers(cell, one);
    for (const std::uint32_t lanes : possible_lanes) {
      RunOptions many;
      many.threads = 8;
      many.lanes = lanes;
      for (const auto& shard : {Shard{1, 1}, Shard{1, 3}, Shard{2, 3}, Shard{3, 3}}) {
        const auto got = numbers(cell, many, shard);
        for (std::uint32_t t = 0; t < cell.trials; ++t)
          if (shard.owns(t)) {
            EXPECT_TRUE(same(got[t], expected[t])) << lanes << " lanes, " << t;
          }
      }
    }
    EXPECT_FALSE(same(expected[0], expected[1]));
  }
}

TEST(FromFleet, EveryMethodMeetsTheTrialsSensorAndIsToldTheNominalOne) {
  const TestFolder folder;
  folder.write("fleet.json", fleet_json(five_with_effects()).dump());
  const auto cell = study_of(folder, next_sensor()).cells[0];
  const Noise noise{5, 3};
  Scenario sensor, again;
  cell.fleet->draw(cell.scenario, noise, sensor);
  Series series, expected;
  make_trial(cell, 5, 3, series);
  synthesise(sensor, noise, expected);
  EXPECT_EQ(series.gyro_dps, expected.gyro_dps);

  Series buffer;
  const auto shared = calibrate_cell(cell, 5, 3, buffer);
  synthesise(cell.scenario, calibration_noise(5, 3), expected);
  EXPECT_EQ(buffer.gyro_dps, expected.gyro_dps) << "calibrated on the nominal sensor";
  const auto told = told_parameters(cell, sensor, cell.methods[1], shared, series);
  EXPECT_EQ(told.at("phi"), shared.random_error.parameters.phi);
  const auto own = told_parameters(cell, sensor, cell.methods[2], shared, series);
  EXPECT_EQ(own.at("measurement_noise_std_dps"), sensor.random_error.measurement_noise_std_dps);

  auto each = cell;
  each.calibration.each_trial = true;
  (void)calibrate_cell(each, 5, 3, buffer);
  synthesise(sensor, calibration_noise(5, 3), expected);
  EXPECT_EQ(buffer.gyro_dps, expected.gyro_dps) << "each on its own sensor";
}

TEST(FromFleet, OtherKeysOverride) {
  const TestFolder folder;
  folder.write("fleet.json", fleet_json(five_with_effects()).dump());
  auto json = next_sensor();
  auto& scenario = json["cells"][0]["scenario"];
  scenario["random_error"]["phi"] = 0.125;
  scenario["thermal_drift"]["c_dps"] = 4;
  scenario["effects"] = Json::array();
  const auto cell = study_of(folder, json).cells[0];
  Scenario sensor;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const auto& s = sensor_of(cell, {5, trial}, sensor);
    EXPECT_EQ(s.random_error.phi, 0.125);
    EXPECT_EQ(s.thermal_drift.c_dps, 4);
    EXPECT_TRUE(s.effects.empty());
  }
  EXPECT_EQ(cell.scenario.sampling.rate_hz, 50);
}

TEST(FromFleet, TwoUnitsMakeAStudy) {
  const TestFolder folder;
  auto units = five();
  units.resize(2);
  folder.write("fleet.json", fleet_json(units).dump());
  folder.write("study.json", next_sensor().dump());
  const auto ended = run_program(folder, {"run", "study.json", "--out", "out"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(run_program(folder, {"validate", "study.json"}).out, HasSubstr("from 2 units"));
}

TEST(FromFleet, TheFleetsContentsAreInTheStudysDigest) {
  const TestFolder folder;
  folder.write("fleet.json", fleet_json(five()).dump());
  const auto before = study_of(folder, next_sensor()).digest;
  EXPECT_EQ(study_of(folder, next_sensor()).digest, before);
  auto other = five();
  other[2].scenario.random_error.phi = 0.6;
  folder.write("fleet.json", fleet_json(other).dump());
  EXPECT_NE(study_of(folder, next_sensor()).digest, before);
}

/// `gyrostat validate` says all of `expected` on one line, and ends with 2.
void expect_refused_with(const Json& fleet, const Json& study, const Words& expected) {
  const TestFolder folder;
  if (!fleet.is_null()) folder.write("fleet.json", fleet.dump());
  folder.write("study.json", study.dump());
  const auto ended = run_program(folder, {"validate", "study.json"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  for (const auto& words : expected) EXPECT_THAT(ended.err, HasSubstr(words));
}

TEST(FromFleet, WhatIsWrongIsToldInOneLine) {
  const auto sound = fleet_json(five());
  const auto with_key = [](const Json& from_fleet) {
    auto study = next_sensor();
    study["cells"][0]["scenario"]["from_fleet"] = from_fleet;
    return study;
  };
  expect_refused_with({}, next_sensor(), {"fleet.json: no such file"});
  expect_refused_with(sound, with_key({{"fil", "fleet.json"}}),
                      {"cells[0].scenario.from_fleet", "'fil'", "'file'"});
  expect_refused_with(sound, with_key({{"file", "fleet.json"}, {"axis", "x"}}),
                      {"cells[0].scenario.from_fleet", "'axis'"});
  auto both = next_sensor();
  both["cells"][0]["scenario"]["from_recording"] = {{"file", "absent.csv"}};
  const TestFolder folder;
  folder.write("study.json", both.dump());
  folder.write("fleet.json", sound.dump());
  EXPECT_THAT(run_program(folder, {"validate", "study.json"}).err,
              HasSubstr("from_fleet: stands beside \"from_recording\"; give one of them"));

  const auto json = next_sensor();
  expect_refused_with({{"cells", 1}}, json, {"fleet.json: is no fleet", "gyrostat diagnose A.csv"});
  expect_refused_with(sound["each"][0]["diagnosis"].patch(
                          Json::parse(R"([{"op": "add", "path": "/verdict", "value": "none"}])")),
                      json, {"fleet.json: is the diagnosis of one recording"});
  auto units = five();
  units.resize(1);
  expect_refused_with(fleet_json(units), json, {"fleet.json", "a fleet of 1 unit", "2 or more"});
  expect_refused_with(fleet_json({}), json, {"fleet.json", "a fleet of no unit"});
  auto axes = sound;
  axes["each"][0]["axis"] = "x";
  expect_refused_with(axes, json, {"fleet.json: each[0]", "an axis of one sensor"});
  auto rates = five();
  rates[4].scenario.sampling.rate_hz = 100;
  expect_refused_with(fleet_json(rates), json, {"fleet.json", "4 is sampled at 100 Hz", "50 Hz"});
  auto bare = sound;
  bare["each"][2]["diagnosis"].erase("enriched");
  expect_refused_with(bare, json, {"fleet.json: each[2].diagnosis", "\"enriched\" is missing"});
  auto beyond = sound;
  beyond["each"][2]["diagnosis"]["enriched"]["random_error"]["phi"] = 2;
  expect_refused_with(beyond, json, {"each[2].diagnosis.enriched.random_error.phi", "(-1, 1)"});
  auto nested = sound;
  nested["each"][2]["diagnosis"]["enriched"]["from_fleet"] = {{"file", "fleet.json"}};
  expect_refused_with(nested, json, {"each[2].diagnosis.enriched.from_fleet", "trials of a study"});
  auto apart = five();
  apart.resize(2);
  apart[0].scenario.random_error.phi = -0.99;
  apart[1].scenario.random_error.phi = 0.99;
  expect_refused_with(fleet_json(apart), json,
                      {"cells[0].scenario.from_fleet", "mostly in phi", "up to half"});
  auto silent = five();
  for (auto& u : silent) u.scenario.random_error.measurement_noise_std_dps = 0.0;
  expect_refused_with(fleet_json(silent), json, {"cells[0].scenario", "R is 0", "from_fleet"});
}

// ---------------------------------------------------------------- from end to end

/// Five units with white noise of a log-normal population are simulated, diagnosed and drawn from.
/// What the fleet says of the population holds it with 99.99 % each: mean by Student's law of 4
/// degrees, standard deviation by chi-squared of 4, both widened by what a fit to 5000 samples adds
/// (a relative error of 1 / sqrt(2 n) = 1 %). Draws are then judged by the law of these five.
TEST(FromFleet, IsThePopulationOfDiagnosedSensors) {
  constexpr double median_dps = 0.05, spread = 0.15, fit_error = 0.01;
  const TestFolder folder;
  std::vector<double> z(5);
  NormalStream(23, 0, "fleet_test units").fill(0, z);
  Words arguments = {"diagnose"};
  for (std::size_t u = 0; u < z.size(); ++u) {
    const double noise_dps = median_dps * std::exp(spread * z[u]);
    const auto name = "unit_" + std::to_string(u);
    folder.write(
        name + ".json",
        Json{{"seed", 100 + u},
             {"cells",
              {{{"scenario",
                 {{"duration_s", 100},
                  {"rate_hz", 50},
                  {"random_error",
                   {{"phi", 0.5}, {"delta1_dps", 2e-4}, {"measurement_noise_std_dps", noise_dps}}},
                  {"thermal_drift", {{"c_dps", 0.1}}}}}}}}}
            .dump());
    ASSERT_EQ(run_program(folder, {"simulate", name + ".json", "--out", name + ".csv"}).exit_code,
              0);
    arguments.push_back(name + ".csv");
  }
  arguments.insert(arguments.end(), {"--json", "fleet.json"});
  const auto diagnosed = run_program(folder, arguments);
  ASSERT_EQ(diagnosed.exit_code, 0) << diagnosed.err;

  const auto cell = study_of(folder, next_sensor()).cells[0];
  std::vector<double> found;
  for (const auto& u : cell.fleet->units()) found.push_back(log_noise(u.scenario));
  const Moments m(found);
  const double total = std::hypot(spread, fit_error);
  EXPECT_NEAR(m.mean, std::log(median_dps),
              student_t_two_sided(0.9999, 4) * m.std / std::sqrt(5.0));
  EXPECT_GT(4 * m.std * m.std / (total * total), chi_squared_quantile(5e-5, 4));
  EXPECT_LT(4 * m.std * m.std / (total * total), chi_squared_upper_quantile(5e-5, 4));
  EXPECT_LT(distance(drawn(*cell.fleet, log_noise), [&](double x) { return m.next_below(x); }),
            once_in_a_million);
  const auto ended = run_program(folder, {"run", "study.json", "--out", "out"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

}  // namespace
}  // namespace gyrostat::fleet_test
