#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::filters_test {
namespace {

using Jet = ceres::Jet<double, 3>;

/// A filter of the registry, sample by sample: the laws below are compiled once, and of each filter
/// only what it does on jets.
class AnyFilter {
 public:
  explicit AnyFilter(std::unique_ptr<RunningFilter> filter) : filter_(std::move(filter)) {}

  Step<double> step(const Sample<double>& s) {
    Step<double> to;
    double status = no_value;
    filter_->run({.t_s = &s.t_s,
                  .temperature_C = &s.temperature_C,
                  .gyro_dps = &s.gyro_dps,
                  .heading_deg = &s.heading_deg,
                  .true_rate_dps = &s.true_rate_dps,
                  .true_drift_dps = &s.true_drift_dps},
                 {&to.estimate_dps, &to.estimate_variance, &to.innovation_dps,
                  &to.innovation_variance, &status},
                 1, 1);
    to.status = static_cast<Status>(static_cast<int>(status));
    return to;
  }

 private:
  std::unique_ptr<RunningFilter> filter_;
};

/// Values of a filter's parameters, in the order of its fields.
using Values = std::vector<double>;

/// One filter of the list: what it says of itself, and how it is made.
struct Listed {
  std::string id;
  const FilterType* type;
  /// Its steps on jets and those of a copy taken half-way, from there on.
  void (*expect_copy_goes_on)(const Values&, const std::vector<Sample<double>>&);
  /// The weighted sum of its estimates on jets, where parameter `moved` goes in direction `moved`
  /// % 3.
  Jet (*sum_on_jets)(const Values&, std::size_t moved, const std::vector<Sample<double>>&);

  bool draws() const { return type->draws_noise; }
  std::span<const FieldInfo> fields() const { return type->fields; }
  Values defaults() const {
    Values values;
    for (const auto& field : fields()) values.push_back(field.value);
    return values;
  }
  AnyFilter make(const Values& values) const { return AnyFilter(type->start(values)); }
  AnyFilter make_default() const { return make(defaults()); }
};

template <class P, class T>
P parameters_of(const std::vector<T>& values) {
  P p;
  std::size_t i = 0;
  for (const auto& field : P::fields()) p.*(field.member) = values[i++];
  return p;
}

template <class T>
Sample<T> cast(const Sample<double>& s) {
  return {T(s.t_s),         T(s.gyro_dps),      T(s.temperature_C),
          T(s.heading_deg), T(s.true_rate_dps), T(s.true_drift_dps)};
}

/// Each estimate is weighted differently, so that no error cancels.
double weight(std::size_t i) { return 1.0 + std::sin(static_cast<double>(i)); }

void expect_same_bits(const Step<double>& a, const Step<double>& b) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  ASSERT_EQ(bits(a.estimate_dps), bits(b.estimate_dps));
  ASSERT_EQ(bits(a.estimate_variance), bits(b.estimate_variance));
  ASSERT_EQ(bits(a.innovation_dps), bits(b.innovation_dps));
  ASSERT_EQ(bits(a.innovation_variance), bits(b.innovation_variance));
  ASSERT_EQ(a.status, b.status);
}

Step<double> values_of(const Step<Jet>& s) {
  return {s.estimate_dps.a, s.estimate_variance.a, s.innovation_dps.a, s.innovation_variance.a,
          s.status};
}

template <class F>
F started(const std::vector<typename F::Scalar>& values) {
  return F(parameters_of<typename F::Parameters>(values));
}

/// The filters of the list.
const std::vector<Listed>& listed() {
  static const std::vector<Listed> all = [] {
    std::vector<Listed> to;
    Filters::for_each([&]<class Plugin>(Plugin) {
      using OnJets = typename Plugin::template on<Jet>;
      static_assert(Filter<OnJets>);
      to.push_back({.id = std::string(Plugin::id),
                    .type = &filter_types().named(Plugin::id, "test"),
                    .expect_copy_goes_on =
                        [](const Values& values, const std::vector<Sample<double>>& samples) {
                          auto original = started<OnJets>({values.begin(), values.end()});
                          const auto half = samples.size() / 2;
                          for (std::size_t i = 0; i < half; ++i)
                            original.step(cast<Jet>(samples[i]));
                          auto copy = original;
                          for (std::size_t i = half; i < samples.size(); ++i) {
                            const auto a = values_of(original.step(cast<Jet>(samples[i])));
                            expect_same_bits(a, values_of(copy.step(cast<Jet>(samples[i]))));
                          }
                        },
                    .sum_on_jets =
                        [](const Values& values, std::size_t moved,
                           const std::vector<Sample<double>>& samples) {
                          std::vector<Jet> jets(values.begin(), values.end());
                          jets[moved].v[static_cast<int>(moved % 3)] = 1.0;
                          auto filter = started<OnJets>(jets);
                          Jet sum(0.0);
                          for (std::size_t i = 0; i < samples.size(); ++i)
                            sum += Jet(weight(i)) * filter.step(cast<Jet>(samples[i])).estimate_dps;
                          return sum;
                        }});
    });
    return to;
  }();
  return all;
}

std::vector<std::string> ids() {
  std::vector<std::string> ids;
  for (const auto& filter : listed()) ids.push_back(filter.id);
  return ids;
}

/// What every filter owes to whoever runs it.
class FilterContract : public testing::TestWithParam<std::string> {
 protected:
  const Listed& it() const {
    return *std::find_if(listed().begin(), listed().end(),
                         [](const Listed& filter) { return filter.id == GetParam(); });
  }
};
INSTANTIATE_TEST_SUITE_P(Each, FilterContract, testing::ValuesIn(ids()),
                         [](const auto& given) { return given.param; });

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

void expect_sound(AnyFilter filter, const std::vector<Sample<double>>& samples,
                  const std::string& where) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    expect_sound(filter.step(samples[i]), where + ", sample " + std::to_string(i));
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// The defaults with every parameter that may be zero, or as close to it as its range allows, at
/// zero.
Values at_zero(const Listed& filter) {
  Values values = filter.defaults();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& field = filter.fields()[i];
    if (field.range.contains(0.0)) values[i] = 0.0;
    if (!field.range.contains(0.0) && field.name.find("std") != std::string_view::npos)
      values[i] = 1e-12;
  }
  return values;
}

TEST_P(FilterContract, OnATameRecordingNothingBreaksDown) {
  auto filter = it().make_default();
  for (const auto& sample : tame(2000)) {
    const auto step = filter.step(sample);
    expect_sound(step, "tame");
    ASSERT_FALSE(is_breakdown(step.status)) << name_of(step.status);
  }
}

TEST_P(FilterContract, NothingThatIsNotFiniteLeavesWhateverComesIn) {
  for (const double share : {0.001, 0.01, 0.1, 0.5, 1.0})
    expect_sound(it().make_default(), wild(4000, share), "share " + std::to_string(share));
}

TEST_P(FilterContract, NothingThatIsNotFiniteLeavesWhereEveryVarianceIsZero) {
  expect_sound(it().make(at_zero(it())), tame(2000), "tame");
  expect_sound(it().make(at_zero(it())), wild(2000, 0.05), "wild");
}

TEST_P(FilterContract, NothingThatIsNotFiniteLeavesWhereOneParameterIsAtAnEndOfItsRange) {
  const auto fields = it().fields();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double from = fields[i].range.from, to = fields[i].range.to;
    for (const double value : {from, to, std::nextafter(from, 1.0), std::nextafter(to, 0.0)}) {
      if (!fields[i].range.contains(value) || std::abs(value) > 1e100) continue;
      auto values = it().defaults();
      values[i] = value;
      expect_sound(it().make(values), tame(500),
                   std::string(fields[i].name) + " = " + std::to_string(value));
    }
  }
}

TEST_P(FilterContract, AMissingSampleIsNoBreakdown) {
  auto filter = it().make_default();
  auto samples = tame(1000);
  for (std::size_t i = 0; i < samples.size(); i += 3) samples[i].gyro_dps = no_value;
  for (std::size_t i = 1; i < samples.size(); i += 3) samples[i].heading_deg = no_value;
  for (std::size_t i = 2; i < samples.size(); i += 3) samples[i].temperature_C = no_value;
  for (const auto& sample : samples) ASSERT_FALSE(is_breakdown(filter.step(sample).status));
}

/// Ninety samples on, an infinite sample has done no more than a missing one would have.
TEST_P(FilterContract, AnInfiniteSampleIsLeftBehind) {
  auto infinite = it().make_default(), missing = it().make_default();
  const auto samples = tame(2000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    auto one = samples[i], other = samples[i];
    if (i % 100 == 50) {
      one.gyro_dps = i % 200 == 50 ? infinity : -infinity;
      one.heading_deg = infinity;
      other.gyro_dps = other.heading_deg = no_value;
    }
    const auto a = infinite.step(one), b = missing.step(other);
    if (i % 100 != 40 || a.estimate_dps == b.estimate_dps) continue;
    ASSERT_LT(std::abs(a.estimate_dps - b.estimate_dps), std::sqrt(a.estimate_variance)) << i;
  }
}

TEST_P(FilterContract, ACopyGoesOnAsTheOriginalDoes) {
  it().expect_copy_goes_on(it().defaults(), tame(1000));
}

TEST_P(FilterContract, TheFutureDoesNotReachThePast) {
  auto one = it().make_default(), other = it().make_default();
  const auto samples = tame(600);
  auto changed = samples;
  for (std::size_t i = 400; i < changed.size(); ++i) changed[i].gyro_dps += 5.0;
  for (std::size_t i = 0; i < 400; ++i)
    expect_same_bits(one.step(samples[i]), other.step(changed[i]));
}

TEST_P(FilterContract, EstimatesOfNothingAreZero) {
  if (it().draws()) GTEST_SKIP() << "its estimate is a draw";
  auto filter = it().make_default();
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(filter.step(Sample<double>{0.2 * i, 0.0, 25.0, 0.0, 0.0, 0.0}).estimate_dps, 0.0);
}

TEST_P(FilterContract, TheMirroredSignalGivesTheMirroredEstimate) {
  if (it().draws()) GTEST_SKIP() << "its estimate is a draw";
  auto filter = it().make_default(), mirror = it().make_default();
  for (auto sample : tame(2000)) {
    const double estimate = filter.step(sample).estimate_dps;
    for (double* value :
         {&sample.gyro_dps, &sample.heading_deg, &sample.true_rate_dps, &sample.true_drift_dps})
      *value = -*value;
    ASSERT_NEAR(mirror.step(sample).estimate_dps, -estimate, 1e-12);
  }
}

/// Parameters inside their ranges, none where a derivative has a kink, no two of them alike.
Values interior(const Listed& filter) {
  Values values = filter.defaults();
  double value = 0.005;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] == 0.0 && !filter.fields()[i].range.whole) values[i] = value += 0.001;
  return values;
}

/// Whether the estimate is differentiable in this parameter.
bool is_smooth(const FieldInfo& field) {
  return !field.range.whole && field.name != "update_interval_s";
}

double weighted_sum(AnyFilter filter, const std::vector<Sample<double>>& samples) {
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    sum += weight(i) * filter.step(samples[i]).estimate_dps;
  return sum;
}

/// The derivative of the weighted sum by each smooth parameter at `p`, against central differences.
void expect_derivatives(const Listed& filter, const Values& p) {
  const auto samples = tame(300);
  const auto at = [&](const Values& q) { return weighted_sum(filter.make(q), samples); };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto& field = filter.fields()[i];
    if (!is_smooth(field)) continue;
    const Jet sum = filter.sum_on_jets(p, i, samples);
    EXPECT_NEAR(sum.a, at(p), 1e-9 * (1.0 + std::abs(at(p)))) << field.name;

    const double h = 1e-4 * p[i];
    auto above = p, below = p;
    above[i] += h;
    below[i] -= h;
    const double difference = (at(above) - at(below)) / (2.0 * h);
    // Truncation of order h^2 and rounding of order 1e-16 / h, relative to the scale of the sum.
    const double scale = std::abs(difference) + 1e-3 / std::abs(p[i]);
    EXPECT_NEAR(sum.v[static_cast<int>(i % 3)], difference, 1e-5 * scale) << field.name;
    EXPECT_EQ(sum.v[static_cast<int>((i + 1) % 3)], 0.0) << field.name;
  }
}

TEST_P(FilterContract, DerivativesOnJetsAreCentralDifferences) {
  if (it().draws()) GTEST_SKIP() << "its estimate is a draw";
  expect_derivatives(it(), interior(it()));
}

/// As a calibration starts every filter: x_k and x_{k-1} alike, so that some correlations are zero
/// there while their derivatives are not.
TEST_P(FilterContract, DerivativesOnJetsHoldWhereTheInitialStatesAreAlike) {
  if (it().draws()) GTEST_SKIP() << "its estimate is a draw";
  auto p = interior(it());
  for (std::size_t i = 0; i < p.size(); ++i)
    if (it().fields()[i].name == "initial_x_dps" ||
        it().fields()[i].name == "initial_x_previous_dps")
      p[i] = 0.02;
  expect_derivatives(it(), p);
}

}  // namespace
}  // namespace gyrostat::filters_test
