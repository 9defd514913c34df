#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::filters_test {
namespace {

using Jet = ceres::Jet<double, 3>;

template <class List>
struct TypesOf;
template <class... Plugins>
struct TypesOf<PluginList<Plugins...>> {
  using type = testing::Types<Plugins...>;
};

struct Ids {
  template <class Plugin>
  static std::string GetName(int) {
    return std::string(Plugin::id);
  }
};

/// What every filter owes to whoever runs it.
template <class Plugin>
class FilterContract : public testing::Test {
 protected:
  using F = typename Plugin::type;
  using P = typename F::Parameters;
};
TYPED_TEST_SUITE(FilterContract, TypesOf<Filters>::type, Ids);

/// One step, compiled once a filter: inlined into every test below it would be most of the build.
template <class F>
[[gnu::noinline]] auto next(F& filter, const Sample<typename F::Scalar>& sample) {
  return filter.step(sample);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A tame recording: slow turning, drifting temperature, noise everywhere, 5 Hz.
std::vector<Sample<double>> tame(std::size_t count) {
  const NormalStream gyro(2, 0, "gyro"), compass(2, 0, "compass");
  std::vector<Sample<double>> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 0.2 * static_cast<double>(i);
    const double rate = 2.0 * std::sin(0.05 * t), drift = 0.1 + 0.02 * std::sin(0.02 * t);
    samples.push_back({.t_s = t,
                       .gyro_dps = rate + drift + 0.05 * gyro.normal(i),
                       .temperature_C = 30.0 + 10.0 * std::sin(0.02 * t),
                       .heading_deg = wrap_degrees(175.0 + 40.0 * (1.0 - std::cos(0.05 * t)) +
                                                   0.1 * compass.normal(i)),
                       .true_rate_dps = rate,
                       .true_drift_dps = drift});
  }
  return samples;
}

/// The tame recording with a share of its measurements replaced by anything that a wire can carry.
std::vector<Sample<double>> wild(std::size_t count, double share) {
  constexpr std::array values = {infinity, -infinity, no_value, 1e300,  -1e300,
                                 1e150,    -1e150,    1e-300,   -0.0,   5e-324,
                                 1e18,     -1e9,      180.0,    -180.0, no_value};
  auto samples = tame(count);
  const NormalStream chance(2, 0, "chance"), choice(2, 0, "choice");
  std::uint64_t at = 0;
  for (auto& sample : samples)
    for (double* value : {&sample.gyro_dps, &sample.temperature_C, &sample.heading_deg}) {
      const auto which = static_cast<std::size_t>(choice.uniform(at) * values.size());
      if (chance.uniform(at++) < share) *value = values[which];
    }
  return samples;
}

/// A step may lack variance or innovation (NaN) but never carry one that is not sound.
void expect_sound(const Step<double>& step, const std::string& where) {
  ASSERT_TRUE(std::isfinite(step.estimate_dps)) << where;
  ASSERT_TRUE(std::isnan(step.estimate_variance) ||
              (std::isfinite(step.estimate_variance) && step.estimate_variance >= 0.0))
      << where << ": variance " << step.estimate_variance;
  ASSERT_EQ(std::isnan(step.innovation_dps), std::isnan(step.innovation_variance)) << where;
  if (std::isnan(step.innovation_dps)) return;
  ASSERT_TRUE(std::isfinite(step.innovation_dps)) << where;
  ASSERT_TRUE(std::isfinite(step.innovation_variance) && step.innovation_variance > 0.0) << where;
}

template <class F>
void expect_sound(F filter, const std::vector<Sample<double>>& samples, const std::string& where) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    expect_sound(next(filter, samples[i]), where + ", sample " + std::to_string(i));
    if (testing::Test::HasFatalFailure()) return;
  }
}

void expect_same_bits(const Step<double>& a, const Step<double>& b) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  ASSERT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
  ASSERT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
  ASSERT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
  ASSERT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
  ASSERT_EQ(a.status, b.status);
}

/// The defaults with every parameter that may be zero, or as close to it as its range allows, at
/// zero.
template <class P>
P at_zero() {
  P p;
  for (const auto& field : p.fields()) {
    if (field.range.contains(0.0)) p.*(field.member) = 0.0;
    if (!field.range.contains(0.0) && field.name.find("std") != std::string_view::npos)
      p.*(field.member) = 1e-12;
  }
  return p;
}

TYPED_TEST(FilterContract, OnATameRecordingNothingBreaksDown) {
  typename TestFixture::F filter{typename TestFixture::P{}};
  for (const auto& sample : tame(2000)) {
    const auto step = next(filter, sample);
    expect_sound(step, "tame");
    ASSERT_FALSE(is_breakdown(step.status)) << name_of(step.status);
  }
}

TYPED_TEST(FilterContract, NothingThatIsNotFiniteLeavesWhateverComesIn) {
  for (const double share : {0.001, 0.01, 0.1, 0.5, 1.0})
    expect_sound(typename TestFixture::F{typename TestFixture::P{}}, wild(4000, share),
                 "share " + std::to_string(share));
}

TYPED_TEST(FilterContract, NothingThatIsNotFiniteLeavesWhereEveryVarianceIsZero) {
  const typename TestFixture::F filter(at_zero<typename TestFixture::P>());
  expect_sound(filter, tame(2000), "tame");
  expect_sound(filter, wild(2000, 0.05), "wild");
}

TYPED_TEST(FilterContract, NothingThatIsNotFiniteLeavesWhereOneParameterIsAtAnEndOfItsRange) {
  const typename TestFixture::P defaults;
  for (const auto& field : defaults.fields())
    for (const double value :
         {field.range.from, field.range.to, std::nextafter(field.range.from, 1.0),
          std::nextafter(field.range.to, 0.0)}) {
      if (!field.range.contains(value) || std::abs(value) > 1e100) continue;
      auto p = defaults;
      p.*(field.member) = value;
      expect_sound(typename TestFixture::F(p), tame(500),
                   std::string(field.name) + " = " + std::to_string(value));
    }
}

TYPED_TEST(FilterContract, AMissingSampleIsNoBreakdown) {
  typename TestFixture::F filter{typename TestFixture::P{}};
  auto samples = tame(1000);
  for (std::size_t i = 0; i < samples.size(); i += 3) samples[i].gyro_dps = no_value;
  for (std::size_t i = 1; i < samples.size(); i += 3) samples[i].heading_deg = no_value;
  for (std::size_t i = 2; i < samples.size(); i += 3) samples[i].temperature_C = no_value;
  for (const auto& sample : samples) ASSERT_FALSE(is_breakdown(next(filter, sample).status));
}

/// Ninety samples on, an infinite sample has done no more than a missing one would have.
TYPED_TEST(FilterContract, AnInfiniteSampleIsLeftBehind) {
  typename TestFixture::F infinite{typename TestFixture::P{}}, missing{typename TestFixture::P{}};
  const auto samples = tame(2000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    auto one = samples[i], other = samples[i];
    if (i % 100 == 50) {
      one.gyro_dps = i % 200 == 50 ? infinity : -infinity;
      one.heading_deg = infinity;
      other.gyro_dps = other.heading_deg = no_value;
    }
    const auto a = next(infinite, one), b = next(missing, other);
    if (i % 100 != 40 || a.estimate_dps == b.estimate_dps) continue;
    ASSERT_LT(std::abs(a.estimate_dps - b.estimate_dps), std::sqrt(a.estimate_variance)) << i;
  }
}

TYPED_TEST(FilterContract, ACopyGoesOnAsTheOriginalDoes) {
  typename TestFixture::F original{typename TestFixture::P{}};
  const auto samples = tame(1000);
  for (std::size_t i = 0; i < 500; ++i) next(original, samples[i]);
  auto copy = original;
  for (std::size_t i = 500; i < samples.size(); ++i) {
    const auto a = next(original, samples[i]);
    expect_same_bits(a, next(copy, samples[i]));
  }
}

TYPED_TEST(FilterContract, TheFutureDoesNotReachThePast) {
  typename TestFixture::F one{typename TestFixture::P{}}, other{typename TestFixture::P{}};
  const auto samples = tame(600);
  auto changed = samples;
  for (std::size_t i = 400; i < changed.size(); ++i) changed[i].gyro_dps += 5.0;
  for (std::size_t i = 0; i < 400; ++i)
    expect_same_bits(next(one, samples[i]), next(other, changed[i]));
}

TYPED_TEST(FilterContract, EstimatesOfNothingAreZero) {
  if (draws_noise<typename TestFixture::F>) GTEST_SKIP() << "its estimate is a draw";
  typename TestFixture::F filter{typename TestFixture::P{}};
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(next(filter, Sample<double>{0.2 * i, 0.0, 25.0, 0.0, 0.0, 0.0}).estimate_dps, 0.0);
}

TYPED_TEST(FilterContract, TheMirroredSignalGivesTheMirroredEstimate) {
  if (draws_noise<typename TestFixture::F>) GTEST_SKIP() << "its estimate is a draw";
  typename TestFixture::F filter{typename TestFixture::P{}}, mirror{typename TestFixture::P{}};
  for (auto sample : tame(2000)) {
    const double estimate = next(filter, sample).estimate_dps;
    for (double* value :
         {&sample.gyro_dps, &sample.heading_deg, &sample.true_rate_dps, &sample.true_drift_dps})
      *value = -*value;
    ASSERT_NEAR(next(mirror, sample).estimate_dps, -estimate, 1e-12);
  }
}

/// Parameters inside their ranges, none where a derivative has a kink, no two of them alike.
template <class P>
P interior() {
  P p;
  double value = 0.005;
  for (const auto& field : p.fields())
    if (p.*(field.member) == 0.0 && !field.range.whole) p.*(field.member) = value += 0.001;
  return p;
}

/// Whether the estimate is differentiable in this parameter.
template <class Field>
bool is_smooth(const Field& field) {
  return !field.range.whole && field.name != "update_interval_s";
}

template <class T>
Sample<T> cast(const Sample<double>& s) {
  return {T(s.t_s),         T(s.gyro_dps),      T(s.temperature_C),
          T(s.heading_deg), T(s.true_rate_dps), T(s.true_drift_dps)};
}

/// The sum of estimates over the recording, each weighted differently so that no error cancels.
template <template <class> class F, class T>
[[gnu::noinline]] T weighted_sum(const typename F<T>::Parameters& p,
                                 const std::vector<Sample<double>>& samples) {
  F<T> filter(p);
  T sum(0.0);
  for (std::size_t i = 0; i < samples.size(); ++i)
    sum +=
        T(1.0 + std::sin(static_cast<double>(i))) * next(filter, cast<T>(samples[i])).estimate_dps;
  return sum;
}

/// The derivative of the weighted sum by each smooth parameter at `p`, against central differences.
template <class Plugin, class P>
void expect_derivatives(const P& p) {
  const auto fields = p.fields();
  static_assert(Filter<typename Plugin::template on<Jet>>);
  using JetParameters = typename Plugin::template on<Jet>::Parameters;
  const auto samples = tame(300);
  const auto at = [&](const P& q) { return weighted_sum<Plugin::template on, double>(q, samples); };
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!is_smooth(fields[i])) continue;
    JetParameters jets;
    for (std::size_t j = 0; j < fields.size(); ++j)
      jets.*(JetParameters::fields()[j].member) = Jet(p.*(fields[j].member));
    (jets.*(JetParameters::fields()[i].member)).v[static_cast<int>(i % 3)] = 1.0;
    const Jet sum = weighted_sum<Plugin::template on, Jet>(jets, samples);
    EXPECT_NEAR(sum.a, at(p), 1e-9 * (1.0 + std::abs(at(p)))) << fields[i].name;

    const double h = 1e-4 * p.*(fields[i].member);
    auto above = p, below = p;
    above.*(fields[i].member) += h;
    below.*(fields[i].member) -= h;
    const double difference = (at(above) - at(below)) / (2.0 * h);
    // Truncation of order h^2 and rounding of order 1e-16 / h, relative to the scale of the sum.
    const double scale = std::abs(difference) + 1e-3 / std::abs(p.*(fields[i].member));
    EXPECT_NEAR(sum.v[static_cast<int>(i % 3)], difference, 1e-5 * scale) << fields[i].name;
    EXPECT_EQ(sum.v[static_cast<int>((i + 1) % 3)], 0.0) << fields[i].name;
  }
}

TYPED_TEST(FilterContract, DerivativesOnJetsAreCentralDifferences) {
  if (draws_noise<typename TestFixture::F>) GTEST_SKIP() << "its estimate is a draw";
  expect_derivatives<TypeParam>(interior<typename TestFixture::P>());
}

/// As a calibration starts every filter: x_k and x_{k-1} alike, so that some correlations are zero
/// there while their derivatives are not.
TYPED_TEST(FilterContract, DerivativesOnJetsHoldWhereTheInitialStatesAreAlike) {
  if (draws_noise<typename TestFixture::F>) GTEST_SKIP() << "its estimate is a draw";
  auto p = interior<typename TestFixture::P>();
  for (const auto& field : p.fields())
    if (field.name == "initial_x_dps" || field.name == "initial_x_previous_dps")
      p.*(field.member) = 0.02;
  expect_derivatives<TypeParam>(p);
}

}  // namespace
}  // namespace gyrostat::filters_test
