#include <gyrostat/core/filters/cascade.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/filters/sr_rsukf.hpp>
#include <gyrostat/core/filters/thermal_stf.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::cascade_test {
namespace {

using filters::Cascade;
using filters::SrRsukf;
using filters::ThermalStf;
using Parameters = filters::CascadeParameters<double>;

constexpr double rate_hz = 10.0;

Parameters parameters() {
  Parameters p;
  p.phi = 0.5;
  p.delta1_dps = 0.002;
  p.delta2_dps = 0.001;
  p.measurement_noise_std_dps = 0.02;
  p.a_dps_per_C = 0.002;
  p.c_dps = -0.05;
  p.update_interval_s = 10.0;
  return p;
}

struct Signal {
  std::vector<Sample<double>> samples;
  std::vector<double> error_dps;

  /// A drift off the linear model plus random error, at rest.
  explicit Signal(std::uint32_t trial, bool with_compass = true) {
    const NormalStream a(11, trial, "a"), v(11, trial, "v"), n(11, trial, "n");
    double x = 0.0, difference = 0.0;
    for (std::uint64_t k = 0; k < 9000; ++k) {
      const double t = static_cast<double>(k) / rate_hz, T = 23.0 + 30.0 * std::sin(t / 250.0);
      difference = 0.5 * difference + 0.002 * a.normal(k + 1) - 0.001 * a.normal(k);
      x += difference;
      error_dps.push_back(0.002 * T - 0.05 + 2e-5 * (T - 23.0) * (T - 23.0) + x);
      samples.push_back({.t_s = t,
                         .gyro_dps = error_dps.back() + 0.02 * v.normal(k),
                         .temperature_C = T,
                         .heading_deg = with_compass ? 0.05 * n.normal(k) : no_value});
    }
  }
};

TEST(Cascade, TakesEveryParameterOfItsPartsUnderItsOwnName) {
  std::set<std::string_view> names;
  for (const auto& field : Parameters::fields())
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
  const auto expect_all = [&](const auto& fields) {
    for (const auto& field : fields) {
      const bool level = field.name == "initial_x_dps" || field.name == "initial_x_previous_dps";
      EXPECT_EQ(names.contains(field.name), !level) << field.name;
    }
  };
  expect_all(ThermalStf<double>::Parameters::fields());
  expect_all(SrRsukf<double>::Parameters::fields());
}

TEST(Cascade, IsTheSumOfThermalStfAndSrRsukfOnWhatItLeaves) {
  auto samples = Signal(0).samples;
  samples[4000].gyro_dps = no_value;
  samples[4100].gyro_dps = std::numeric_limits<double>::infinity();
  const auto p = parameters();
  Cascade<double> cascade(p);
  ThermalStf<double> thermal(p);
  SrRsukf<double> fast(p);
  for (auto sample : samples) {
    const auto both = cascade.step(sample);
    const auto slow = thermal.step(sample);
    sample.gyro_dps -= slow.estimate_dps;
    const auto rest = fast.step(sample);
    EXPECT_DOUBLE_EQ(both.estimate_dps, slow.estimate_dps + rest.estimate_dps);
    EXPECT_DOUBLE_EQ(both.estimate_variance, slow.estimate_variance + rest.estimate_variance);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(both.innovation_dps),
              std::bit_cast<std::uint64_t>(rest.innovation_dps));
    EXPECT_EQ(both.status, is_breakdown(slow.status) ? slow.status : rest.status);
  }
}

TEST(Cascade, WithoutDriftToEstimateIsSrRsukf) {
  auto p = parameters();
  p.a_dps_per_C = p.b_dps_s_per_C = p.c_dps = 0.0;
  Cascade<double> cascade(p);
  SrRsukf<double> fast(p);
  for (const auto& sample : Signal(0, false).samples)
    EXPECT_EQ(cascade.step(sample).estimate_dps, fast.step(sample).estimate_dps);
}

struct Squares {
  double cascade = 0.0, thermal = 0.0, fast = 0.0;
};

/// Mean squared errors of the estimate of the whole error, after the first minute.
Squares squared_errors(std::uint32_t trial) {
  const auto p = parameters();
  const Signal signal(trial);
  Cascade<double> cascade(p);
  ThermalStf<double> thermal(p);
  SrRsukf<double> fast(p);
  Squares sums;
  for (std::size_t k = 0; k < signal.samples.size(); ++k) {
    const double e = signal.error_dps[k];
    const double errors[] = {cascade.step(signal.samples[k]).estimate_dps - e,
                             thermal.step(signal.samples[k]).estimate_dps - e,
                             fast.step(signal.samples[k]).estimate_dps - e};
    if (k < 600) continue;
    sums.cascade += errors[0] * errors[0] / 8400.0;
    sums.thermal += errors[1] * errors[1] / 8400.0;
    sums.fast += errors[2] * errors[2] / 8400.0;
  }
  return sums;
}

/// At rest the fast part sees what the compass is too coarse for; the thermal part alone does not.
TEST(Cascade, AtRestIsBetterThanItsThermalPartInEveryTrial) {
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const auto sums = squared_errors(trial);
    EXPECT_LT(sums.cascade, 0.5 * sums.thermal) << trial;
  }
}

}  // namespace
}  // namespace gyrostat::cascade_test
