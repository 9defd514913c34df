#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <gyrostat/core/models/nl_unscented.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/core/reference/dense_unscented.hpp>

namespace gyrostat::structure_test {
namespace {

/// Parameters, risk and data of one comparison, all drawn at random.
struct Draw {
  NlParameters<double> p;
  Vector<double, 7> mu;
  std::vector<double> z;
};

double between(double low, double high, double u) { return low + (high - low) * u; }
double between_decades(double low, double high, double u) {
  return std::pow(10.0, between(low, high, u));
}

Draw draw(std::uint32_t number, std::size_t samples) {
  const NormalStream uniforms(1, number, "structure"), normals(1, number, "structure/z");
  std::uint64_t at = 0;
  const auto u = [&] { return uniforms.uniform(at++); };
  Draw d;
  d.p.phi = between(-0.95, 0.95, u());
  d.p.delta1_dps = between_decades(-4, 0, u());
  d.p.delta2_dps = between(-1.0, 1.0, u()) * d.p.delta1_dps;
  d.p.measurement_noise_std_dps = between_decades(-4, 0, u());
  d.p.initial_x_dps = between(-1.0, 1.0, u());
  d.p.initial_x_std_dps = between_decades(-3, 1, u());
  d.p.initial_x_previous_std_dps = between_decades(-3, 1, u());
  d.p.initial_phi_std = between_decades(-3, -0.5, u());
  d.p.initial_delta1_std_dps = between_decades(-6, -1, u());
  d.p.initial_delta2_std_dps = between_decades(-6, -1, u());
  d.p.alpha = between_decades(-2, 0.3, u());
  d.p.beta = between(0.0, 3.0, u());
  d.p.kappa = between(-4.0, 3.0, u());
  for (int i = 0; i < 7; ++i) d.mu(i) = between_decades(-4, -1.5, u());
  for (std::size_t k = 0; k < samples; ++k)
    d.z.push_back(d.p.initial_x_dps + 3.0 * d.p.measurement_noise_std_dps * normals.normal(k));
  d.z[samples / 2] = no_value;
  return d;
}

/// What differs between two steps, in units of the innovation's deviation and of the variances.
double distance(const Step<double>& a, const Step<long double>& b) {
  const long double S =
      std::isnan(b.innovation_variance) ? b.estimate_variance : b.innovation_variance;
  long double worst = std::abs(a.estimate_dps - b.estimate_dps) / std::sqrt(S);
  worst = std::max(worst, std::abs(a.estimate_variance - b.estimate_variance) / S);
  if (!std::isnan(b.innovation_variance))
    worst = std::max({worst, std::abs(a.innovation_dps - b.innovation_dps) / std::sqrt(S),
                      std::abs(a.innovation_variance / b.innovation_variance - 1)});
  return static_cast<double>(worst);
}

/// Steps until the first difference beyond `tolerance` or in status, if any.
std::size_t steps_alike(const Draw& d, bool with_risk, double tolerance) {
  NlUnscented<double> structured(d.p);
  reference::DenseUnscented<long double> dense(cast_parameters<long double>(d.p));
  const NlRisk<double> risk(d.mu);
  std::optional<Vector<long double, 7>> mu;
  if (with_risk) mu = d.mu.cast<long double>();
  for (std::size_t k = 0; k < d.z.size(); ++k) {
    const auto a = nl_cycle(structured, d.z[k], with_risk ? &risk : nullptr);
    const auto b = reference::dense_cycle(dense, mu, static_cast<long double>(d.z[k]));
    if (a.status != b.status || !(distance(a, b) < tolerance)) return k;
  }
  return d.z.size();
}

TEST(Structure, LeavesTheSrUkfWhatItIsOverRandomParameters) {
  for (std::uint32_t number = 0; number < 300; ++number) {
    const auto d = draw(number, 200);
    EXPECT_EQ(steps_alike(d, false, 1e-9), d.z.size()) << number;
  }
}

TEST(Structure, LeavesTheSrRsukfWhatItIsUnderAnyDiagonalRisk) {
  for (std::uint32_t number = 0; number < 300; ++number) {
    auto d = draw(number, 100);
    EXPECT_EQ(steps_alike(d, true, 1e-8), d.z.size()) << number;
  }
}

/// Covariance of all seven states by the dense form, and of those that the structured form keeps.
TEST(Structure, KeepsTheWholeCovarianceOfTheDenseForm) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    const auto d = draw(number, 50);
    NlUnscented<double> structured(d.p);
    reference::DenseUnscented<long double> dense(cast_parameters<long double>(d.p));
    for (const double z : d.z) {
      nl_cycle(structured, z);
      reference::dense_cycle(dense, {}, static_cast<long double>(z));
    }
    const Matrix<double, 7> a = structured.root() * structured.root().transpose();
    const Matrix<double, 7> b = (dense.root() * dense.root().transpose()).cast<double>();
    const Vector<double, 7> unit = b.diagonal().cwiseSqrt();
    EXPECT_LT(((a - b).array() / (unit * unit.transpose()).array()).abs().maxCoeff(), 1e-8)
        << number;
    EXPECT_LT((structured.mean() - dense.mean().cast<double>()).cwiseAbs().maxCoeff(), 1e-9)
        << number;
  }
}

/// Up to a part in 1e9 from where P^-1 - 2 mu loses definiteness both forms agree that the update
/// exists, and beyond it that it does not.
TEST(Structure, FindsTheSameEdgeOfTheRiskUpdate) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    const auto d = draw(number, 20);
    reference::DenseUnscented<long double> dense(cast_parameters<long double>(d.p));
    NlUnscented<double> structured(d.p);
    for (const double z : d.z) {
      nl_cycle(structured, z);
      reference::dense_cycle(dense, {}, static_cast<long double>(z));
    }
    ASSERT_TRUE(dense.time_update());
    ASSERT_TRUE(structured.time_update());
    long double low = 0.0, high = 1e12;
    for (int halving = 0; halving < 200; ++halving) {
      const long double scale = 0.5L * (low + high);
      auto trial = dense;
      (trial.risk_update(scale * d.mu.cast<long double>()) ? low : high) = scale;
    }
    for (const double margin : {1e-3, 1e-6, 1e-9}) {
      const auto edge = static_cast<double>(low);
      auto inside = structured, outside = structured;
      EXPECT_TRUE(inside.risk_update(NlRisk<double>(edge * (1.0 - margin) * d.mu))) << number;
      EXPECT_FALSE(outside.risk_update(NlRisk<double>(edge * (1.0 + margin) * d.mu))) << number;
      auto reference = dense;
      ASSERT_TRUE(reference.risk_update((low * (1.0L - margin)) * d.mu.cast<long double>()));
      const double relative = inside.variance() / static_cast<double>(reference.variance()) - 1.0;
      EXPECT_LT(std::abs(relative), 1e-12 / margin + 1e-9) << number << ", " << margin;
    }
  }
}

/// A kappa below -4 gives a central weight so negative that the covariance after the time update
/// may not exist: both forms leave out the same steps.
TEST(Structure, LeavesOutTheSameStepsWhereTheCentralWeightTakesDefinitenessAway) {
  std::size_t broken = 0;
  for (std::uint32_t number = 0; number < 200; ++number) {
    auto d = draw(number, 30);
    d.p.alpha = 2.0;
    d.p.beta = 0.0;
    d.p.kappa = -6.5;
    d.p.initial_phi_std = 2.0;
    d.p.measurement_noise_std_dps *= 1e-2;
    NlUnscented<double> structured(d.p);
    reference::DenseUnscented<long double> dense(cast_parameters<long double>(d.p));
    for (const double z : d.z) {
      const auto a = nl_cycle(structured, z);
      const auto b = reference::dense_cycle(dense, {}, static_cast<long double>(z));
      ASSERT_EQ(name_of(a.status), name_of(b.status)) << number;
      broken += is_breakdown(a.status);
    }
  }
  EXPECT_GT(broken, 0U);
}

}  // namespace
}  // namespace gyrostat::structure_test
