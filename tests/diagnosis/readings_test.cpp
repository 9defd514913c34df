// What the lenses are built on: spectra, octaves, the split of a recording, and the lenses'
// contract.

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include <gyrostat/analysis/spectra/welch.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/proportion.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/gap/ensemble.hpp>
#include <gyrostat/diagnosis/gap/instrument.hpp>
#include <gyrostat/diagnosis/lenses/list.hpp>
#include <gyrostat/diagnosis/likelihood/tails.hpp>

namespace gyrostat::gap::readings_test {
namespace {

std::vector<double> white(std::size_t count, std::string_view name = "white") {
  std::vector<double> values(count);
  NormalStream(11, 0, name).fill(0, values);
  return values;
}

/// Everything that a lens may look at.
Series rich(std::size_t samples = 12000, double rate_hz = 20.0) {
  Series s;
  s.gyro_dps = white(samples);
  const auto compass = white(samples, "compass");
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / rate_hz;
    s.t_s.push_back(t);
    s.temperature_C.push_back(40.0 - 17.0 * std::cos(t / 60.0));
    s.rate_ref_dps.push_back(60.0 * std::sin(0.2 * t));
    s.heading_deg.push_back(wrap_degrees(300.0 * (1.0 - std::cos(0.2 * t)) + 0.3 * compass[i]));
    s.acc_x_mps2.push_back(3.0 * std::sin(0.05 * t));
    s.acc_y_mps2.push_back(2.0 * std::cos(0.03 * t));
    s.acc_z_mps2.push_back(9.8);
    s.gyro_dps[i] = 0.05 * s.gyro_dps[i] + s.rate_ref_dps[i];
  }
  return s;
}

// One-sided density of white noise: 2 sigma^2 / rate. The mean over bins of 256 segments has a
// relative standard error of about 1 / sqrt(256 * 100); five of them fail once in a million.
TEST(Welch, WhiteNoiseHasItsDensity) {
  const auto values = white(256 * 256);
  const std::span<const double> stretch(values);
  const auto spectrum = welch({&stretch, 1}, 50.0, 256, 256);
  ASSERT_EQ(spectrum.segments, 256U);
  double mean = 0.0;
  for (std::size_t k = 10; k < 110; ++k) mean += spectrum.density[k] / 100.0;
  EXPECT_NEAR(mean, 2.0 / 50.0, 5.0 * (2.0 / 50.0) / std::sqrt(25600.0) * 1.5);
}

TEST(Welch, ASineHasHalfItsSquaredAmplitude) {
  std::vector<double> values(4096);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = 3.0 * std::sin(2.0 * std::numbers::pi * 0.125 * static_cast<double>(i));
  const std::span<const double> stretch(values);
  const auto spectrum = welch({&stretch, 1}, 1.0, 512, 256);
  double power = 0.0;
  for (const double density : spectrum.density) power += density * spectrum.resolution_hz;
  EXPECT_NEAR(power, 4.5, 1e-9);
}

TEST(Welch, PassesOverStretchesThatAreTooShort) {
  const auto values = white(100);
  const std::span<const double> stretch(values);
  EXPECT_TRUE(welch({&stretch, 1}, 1.0, 128, 64).density.empty());
}

// The Allan variance of white noise is sigma^2 / m; differences of 2^16 / m means have about
// 2 / 3 * 2^16 / m degrees of freedom.
TEST(Octaves, AreTheAllanVarianceOfWhiteNoise) {
  const auto values = white(65536);
  const std::vector<Span> spans = {{0, values.size()}};
  for (const auto& octave : octaves(values, spans)) {
    const double m = static_cast<double>(octave.cluster);
    const double degrees = 0.66 * static_cast<double>(octave.count);
    if (degrees < 50.0) continue;
    EXPECT_NEAR(0.5 * octave.mean_square * m, 1.0, 5.0 * std::sqrt(2.0 / degrees)) << m;
    EXPECT_NEAR(octave.kurtosis, 3.0, 5.0 * std::sqrt(96.0 / degrees)) << m;
  }
}

TEST(Octaves, TwoLevelsHaveALevelKurtosisOfOne) {
  std::vector<double> values(4096);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i / 64 % 2 == 0 ? 1.0 : -1.0;
  const std::vector<Span> spans = {{0, values.size()}};
  EXPECT_NEAR(octaves(values, spans)[2].level_kurtosis, 1.0, 1e-12);
}

TEST(Octaves, MissingValuesArePassedOver) {
  auto values = white(4096);
  for (std::size_t i = 0; i < values.size(); i += 9) values[i] = no_value;
  const std::vector<Span> spans = {{0, values.size()}};
  const auto found = octaves(values, spans);
  EXPECT_NEAR(found[0].mean_square, 2.0, 0.3);
}

TEST(Conditions, HoldOutTheThirdAndTheSeventhOfEightBlocks) {
  const Conditions conditions(rich(8000));
  std::vector<int> seen(8000, 0);
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part))
      for (std::size_t i = span.first; i < span.last; ++i) seen[i] += part == Part::train ? 1 : 10;
  for (std::size_t i = 0; i < seen.size(); ++i)
    ASSERT_EQ(seen[i], i / 1000 == 2 || i / 1000 == 6 ? 10 : 1) << i;
}

TEST(Conditions, BridgeShortGapsAndBreakAtLongOnes) {
  Series s = rich(8000);
  for (std::size_t i = 100; i < 105; ++i) s.gyro_dps[i] = no_value;
  for (std::size_t i = 400; i < 406; ++i) s.gyro_dps[i] = no_value;
  const Conditions conditions(s);
  auto values = s.gyro_dps;
  conditions.bridge(values);
  EXPECT_NEAR(values[102], values[99] + 0.5 * (values[105] - values[99]), 1e-12);
  EXPECT_TRUE(std::isnan(values[403]));
  const auto& spans = conditions.spans(Part::train);
  EXPECT_EQ(spans[0].first, 0U);
  EXPECT_EQ(spans[0].last, 400U);
  EXPECT_EQ(spans[1].first, 406U);
}

// Of lengths that no cluster divides, too.
TEST(Conditions, NeverMixThePartsInAMeanOrABridge) {
  for (const std::size_t samples : {8000U, 24010U, 65067U}) {
    Series s = rich(samples);
    const std::size_t edge = Conditions(s).spans(Part::held_out).front().first;
    for (std::size_t i = edge - 1; i < edge + 2; ++i) s.gyro_dps[i] = no_value;
    const Conditions conditions(s);
    for (const auto& span : conditions.slow_spans(Part::train))
      for (std::size_t i = span.first * conditions.cluster(); i < span.last * conditions.cluster();
           ++i)
        ASSERT_EQ(conditions.part_of(i), Part::train) << samples << " " << i;
    auto values = s.gyro_dps;
    conditions.bridge(values);
    EXPECT_TRUE(std::isnan(values[edge])) << samples;
  }
}

// Newcombe, Statistics in Medicine 17, 1998, table I: 81 of 263 gives 0.2553 to 0.3662.
TEST(WilsonInterval, IsThePublishedOne) {
  const auto [low, high] = wilson_interval(81, 263, 0.95);
  EXPECT_NEAR(low, 0.2553, 5e-5);
  EXPECT_NEAR(high, 0.3662, 5e-5);
}

TEST(WilsonInterval, HoldsTheShareThatWasSeen) {
  for (int count = 1; count <= 2000; ++count) {
    EXPECT_EQ(wilson_interval(0, count, 0.95).first, 0.0) << count;
    EXPECT_EQ(wilson_interval(count, count, 0.95).second, 1.0) << count;
  }
}

template <class Entry>
class LensContract : public testing::Test {};

template <class List>
struct AsTypes;
template <class... Entries>
struct AsTypes<PluginList<Entries...>> {
  using type = testing::Types<Entries...>;
};
TYPED_TEST_SUITE(LensContract, typename AsTypes<Lenses>::type);

TYPED_TEST(LensContract, ReadsFiniteNumbersWhereItLooks) {
  const Series s = rich();
  const Conditions conditions(s);
  const Scene scene(conditions, s);
  for (const Part part : both_parts) {
    const typename TypeParam::type lens(conditions, part);
    ASSERT_FALSE(lens.at.empty());
    std::vector<double> readings(lens.at.size() + 1, -777.0), again = readings;
    lens.read(scene, std::span(readings).first(lens.at.size()));
    lens.read(scene, std::span(again).first(lens.at.size()));
    for (std::size_t i = 0; i < lens.at.size(); ++i) {
      EXPECT_TRUE(std::isfinite(readings[i])) << i;
      EXPECT_LE(lens.at[i].from, lens.at[i].to);
    }
    EXPECT_EQ(readings, again);
    EXPECT_EQ(readings.back(), -777.0) << "wrote more than it has";
  }
}

TYPED_TEST(LensContract, DoesNotSeeTheOtherPart) {
  const Series s = rich();
  Series other = s;
  const auto noise = white(s.size(), "other");
  const Conditions conditions(s);
  for (const auto& span : conditions.spans(Part::held_out))
    for (std::size_t i = span.first; i < span.last; ++i) {
      other.gyro_dps[i] += noise[i];
      other.heading_deg[i] = wrap_degrees(other.heading_deg[i] + 20.0 * noise[i]);
    }
  const typename TypeParam::type lens(conditions, Part::train);
  std::vector<double> before(lens.at.size()), after(lens.at.size());
  lens.read(Scene(conditions, s), before);
  lens.read(Scene(conditions, other), after);
  EXPECT_EQ(before, after);
}

TYPED_TEST(LensContract, IsAbsentWhereItsChannelIs) {
  Series bare;
  bare.t_s = rich().t_s;
  bare.gyro_dps = white(bare.t_s.size());
  const Conditions conditions(bare);
  const typename TypeParam::type lens(conditions, Part::train);
  const std::string_view coordinate = TypeParam::type::coordinate;
  if (TypeParam::type::channel == "heading_deg" || coordinate == "temperature_C" ||
      coordinate == "rate_dps") {
    EXPECT_TRUE(lens.at.empty());
  }
}

/// Noise on a grid of twice its size: of the steps between samples 52 % are none where the level is
/// on the grid, and 46 % where it is between; their median is none or one step of the grid, which
/// moved the share of large ones by e^7.
TEST(Exceedances, HardlyMoveWithTheLevelOnACoarseGrid) {
  const auto at_level = [](double level_dps) {
    Series s = rich();
    const auto noise = white(s.size());
    s.rate_ref_dps.clear();
    for (std::size_t i = 0; i < s.size(); ++i)
      s.gyro_dps[i] = 0.1 * std::round((level_dps + 0.05 * noise[i]) / 0.1);
    const Conditions conditions(s);
    const lenses::Exceedances lens(conditions, Part::train);
    std::vector<double> shares(lens.at.size());
    lens.read(Scene(conditions, s), shares);
    return shares;
  };
  const auto on = at_level(0.0), between = at_level(0.05);
  ASSERT_EQ(on.size(), lenses::Exceedances::beyond.size());
  for (std::size_t k = 0; k < on.size(); ++k) EXPECT_NEAR(on[k], between[k], 2.5) << k;
}

/// A column of white noise for each replica.
Eigen::MatrixXd white_readings(const Instrument& instrument, Eigen::Index replicas) {
  Eigen::MatrixXd readings(instrument.size(), replicas);
  for (Eigen::Index k = 0; k < replicas; ++k) {
    const auto noise = white(static_cast<std::size_t>(instrument.size()), std::to_string(k));
    readings.col(k) = Eigen::Map<const Eigen::VectorXd>(noise.data(), instrument.size());
  }
  return readings;
}

/// What all replicas read alike has the least spread that its lens credits it with: a recording
/// that differs by half of that is none that the simulator could not make, and one that differs by
/// a hundred of them is.
TEST(Ensemble, CreditsAReadingThatNeverVariesWithItsLeastSpread) {
  const Conditions conditions(rich());
  const Instrument instrument(conditions, Part::train);
  constexpr Eigen::Index replicas = 50;
  Eigen::MatrixXd readings = white_readings(instrument, replicas);
  const auto& lenses = instrument.lenses();
  const auto lattice = std::find_if(lenses.begin(), lenses.end(),
                                    [](const auto& lens) { return lens.id == "lattice"; });
  ASSERT_NE(lattice, lenses.end());
  readings.middleRows(lattice->first, lattice->count).setConstant(-8.0);
  const Ensemble ensemble(instrument, readings, {});
  Eigen::VectorXd recording = readings.rowwise().mean();
  const auto typical = ensemble.p_value(readings.col(0));
  for (Eigen::Index i = 0; i < recording.size(); ++i)
    if (i < lattice->first || i >= lattice->first + lattice->count) recording[i] = readings(i, 0);
  EXPECT_GE(ensemble.p_value(recording), 0.5 * typical);
  recording[lattice->first] += 0.5 * lattice->least_spread;
  EXPECT_GE(ensemble.p_value(recording), 0.5 * typical);
  recording[lattice->first] += 100.0 * lattice->least_spread;
  EXPECT_LT(ensemble.p_value(recording), 1e-3);
}

/// A lens of eight readings that lie so near to the mean as one replica in 100,000: it is said, and
/// not with a probability of 1e-8, which the left tail of a logarithm's normal law has there.
TEST(Ensemble, ReadingsNearTheMeanAreAsOddAsChiSquaredHasIt) {
  const Conditions conditions(rich());
  const Instrument instrument(conditions, Part::train);
  constexpr Eigen::Index replicas = 32;
  const Eigen::MatrixXd readings = white_readings(instrument, replicas + 1);
  const auto& lenses = instrument.lenses();
  const auto eight =
      std::find_if(lenses.begin(), lenses.end(), [](const auto& lens) { return lens.count == 8; });
  ASSERT_NE(eight, lenses.end());
  const Ensemble ensemble(instrument, readings.leftCols(replicas), {});
  Eigen::VectorXd recording = readings.col(replicas);
  constexpr double odd = 1e-5;
  recording.segment(eight->first, 8) = ensemble.mean().segment(eight->first, 8);
  recording.segment(eight->first, 8) +=
      std::sqrt(chi_squared_quantile(odd, 8.0) / 8.0) * ensemble.spread().segment(eight->first, 8);
  EXPECT_GT(ensemble.p_value(recording), odd);
  EXPECT_LT(ensemble.p_value(recording), 0.01);
}

/// A recording that is a replica but in its heading is odd by that alone.
TEST(Ensemble, TellsWhatIsOddInOneChannelAlone) {
  const Conditions conditions(rich());
  const Instrument instrument(conditions, Part::train);
  constexpr Eigen::Index replicas = 50;
  const Eigen::MatrixXd readings = white_readings(instrument, replicas);
  const Ensemble ensemble(instrument, readings, {});
  Eigen::VectorXd recording = readings.col(0);
  const auto typical = ensemble.p_value(recording);
  EXPECT_GE(ensemble.p_value_without("heading_deg", recording), typical);
  for (const auto& lens : instrument.lenses())
    if (lens.channel == "heading_deg") recording.segment(lens.first, lens.count) *= 10.0;
  EXPECT_LT(ensemble.p_value(recording), 1e-3);
  EXPECT_GE(ensemble.p_value_without("heading_deg", recording), typical);
}

/// A hundred samples of ten times the noise are outliers where they are scattered, and none where
/// they come ten in a row.
TEST(Tails, AreOfWhatComesOneByOne) {
  const Series plain = rich();
  const Conditions conditions(plain);
  auto scattered = white(plain.size()), crowded = scattered;
  for (std::size_t k = 0; k < 100; ++k) {
    scattered[(k * 7919) % plain.size()] *= 10.0;
    crowded[k / 10 * 1200 + k % 10] *= 10.0;
  }
  constexpr double clear = 30.0;
  EXPECT_GT(tails_of(conditions, scattered, false).outlier_gain, clear);
  EXPECT_LT(tails_of(conditions, crowded, false).outlier_gain, clear);
}

}  // namespace
}  // namespace gyrostat::gap::readings_test
