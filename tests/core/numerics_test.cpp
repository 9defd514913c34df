#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <gyrostat/core/numerics/cholesky.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/numerics/kalman.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/numerics/sine_of_turns.hpp>
#include <gyrostat/core/numerics/unscented.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/core/reference/dense_unscented.hpp>

namespace gyrostat::numerics_test {
namespace {

using reference::downdate_root;
using reference::lower_root;

constexpr int n = 7;
using Square = Matrix<double, n>;
using Column = Vector<double, n>;

/// Random matrices, all different, from one stream.
class Numerics : public testing::Test {
 protected:
  template <int Rows, int Columns>
  Matrix<double, Rows, Columns> random() {
    Matrix<double, Rows, Columns> m;
    for (int j = 0; j < Columns; ++j)
      for (int i = 0; i < Rows; ++i) m(i, j) = stream_.normal(at_++);
    return m;
  }

  /// A lower root with a diagonal of mixed signs, well away from zero.
  Square random_root() {
    Square root = random<n, n>().triangularView<Eigen::Lower>();
    for (int i = 0; i < n; ++i) root(i, i) += root(i, i) < 0.0 ? -2.0 : 2.0;
    return root;
  }

  Column random_direction() { return random<n, 1>().normalized(); }

  static constexpr int repetitions = 200;

 private:
  NormalStream stream_{1, 0, "numerics"};
  std::uint64_t at_ = 0;
};

/// What is expected is computed in matrices of one type, of any size: types cost most of the time
/// that this file compiles.
using Dense = Eigen::MatrixXd;

Dense square(const Dense& root) { return root * root.transpose(); }

void expect_close(const Dense& a, const Dense& b, double tolerance = 1e-12) {
  EXPECT_LE((a - b).norm(), tolerance * (1.0 + b.norm())) << a << "\n\n" << b;
}

bool is_lower(const Square& root) {
  return root.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().isZero(0.0);
}

TEST_F(Numerics, LowerRootTimesItsTransposeIsTheGramMatrix) {
  for (int k = 0; k < repetitions; ++k) {
    const auto a = random<n, 2 * n>();
    const Square root = lower_root<double, n, 2 * n>(a);
    EXPECT_TRUE(is_lower(root));
    expect_close(square(root), square(a));
  }
}

TEST_F(Numerics, LowerRootStandsSingularMatrices) {
  for (int rank = 0; rank < n; ++rank) {
    Matrix<double, n, 2 * n> a = Matrix<double, n, 2 * n>::Zero();
    for (int k = 0; k < rank; ++k) a += random<n, 1>() * random<1, 2 * n>();
    const Square root = lower_root<double, n, 2 * n>(a);
    EXPECT_TRUE(is_lower(root));
    expect_close(square(root), square(a));
  }
}

TEST_F(Numerics, LowerRootStandsZeroRowsAndScalesFarApart) {
  for (int row = 0; row < n; ++row) {
    auto a = random<n, 2 * n>();
    a.row(row).setZero();
    expect_close(square(lower_root<double, n, 2 * n>(a)), square(a));
    a.row(row) = 1e-9 * random<1, 2 * n>();
    const Square root = lower_root<double, n, 2 * n>(a);
    EXPECT_NEAR(root.row(row).norm(), a.row(row).norm(), 1e-12 * a.row(row).norm());
  }
}

/// A known state is a zero row; every direction short of the others' spread stays downdatable.
TEST_F(Numerics, LowerRootWithAKnownStateStaysDowndatable) {
  for (int k = 0; k < repetitions; ++k) {
    auto a = random<n, 2 * n>();
    a.row(k % n).setZero();
    Square root = lower_root<double, n, 2 * n>(a);
    const Column v = 0.999 * a * random<2 * n, 1>().normalized();
    ASSERT_TRUE((downdate_root<double, n>(root, v)));
    expect_close(square(root), square(a) - square(v));
  }
}

TEST_F(Numerics, LowerRootOfALowerRootIsItself) {
  const Square root = random_root();
  expect_close(lower_root<double, n, n>(root), root, 0.0);
}

TEST_F(Numerics, UpdateAddsTheOuterProduct) {
  for (int k = 0; k < repetitions; ++k) {
    Square root = random_root();
    const Column v = random<n, 1>();
    const Dense expected = square(root) + square(v);
    update_root<double, n>(root, v);
    EXPECT_TRUE(is_lower(root));
    expect_close(square(root), expected);
  }
}

TEST_F(Numerics, UpdateStandsARootThatIsZeroOrSingular) {
  Square root = Square::Zero();
  Dense expected = Dense::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    Column v = random<n, 1>();
    v.head(k / 2).setZero();
    expected += square(v);
    update_root<double, n>(root, v);
    expect_close(square(root), expected);
  }
}

TEST_F(Numerics, DowndateSubtractsTheOuterProduct) {
  for (int k = 0; k < repetitions; ++k) {
    Square root = random_root();
    const Column v = root * random_direction() * 0.9;
    const Dense expected = square(root) - square(v);
    ASSERT_TRUE((downdate_root<double, n>(root, v)));
    EXPECT_TRUE(is_lower(root));
    expect_close(square(root), expected);
  }
}

TEST_F(Numerics, DowndateUndoesUpdate) {
  for (int k = 0; k < repetitions; ++k) {
    const Square before = random_root();
    Square root = before;
    const Column v = random<n, 1>();
    update_root<double, n>(root, v);
    ASSERT_TRUE((downdate_root<double, n>(root, v)));
    expect_close(square(root), square(before));
  }
}

TEST_F(Numerics, DowndateLeavesSingularDirectionsThatItDoesNotTouch) {
  Square root = random_root();
  root.row(3).setZero();
  root.col(3).setZero();
  Column v = root * random_direction() * 0.5;
  ASSERT_EQ(v(3), 0.0);
  const Dense expected = square(root) - square(v);
  ASSERT_TRUE((downdate_root<double, n>(root, v)));
  expect_close(square(root), expected);
  v(3) = 1e-3;
  EXPECT_FALSE((downdate_root<double, n>(root, v)));
}

/// L L^T - (L u)(L u)^T = L (I - u u^T) L^T is positive definite exactly while |u| < 1.
TEST_F(Numerics, DowndateRefusesExactlyWhereTheDifferenceIsNotPositiveDefinite) {
  for (int k = 0; k < repetitions; ++k)
    for (const double margin : {1e-2, 1e-5, 1e-8, 1e-11}) {
      const Square before = random_root();
      const Column boundary = before * random_direction();
      Square root = before;
      const Column inside = boundary * (1.0 - margin);
      ASSERT_TRUE((downdate_root<double, n>(root, inside))) << margin;
      expect_close(square(root), square(before) - square(inside));
      root = before;
      EXPECT_FALSE((downdate_root<double, n>(root, boundary * (1.0 + margin)))) << margin;
      EXPECT_TRUE((root.array() == before.array()).all()) << "the root was touched";
    }
}

Dense inverse(const Dense& symmetric) { return invert_symmetric(symmetric).inverse; }

/// The paper's own form, [A eq. 15] in terms of covariance.
Dense inflated(const Dense& P, const Eigen::VectorXd& mu) {
  const Dense twice_mu = 2.0 * Dense(mu.asDiagonal());
  return inverse(inverse(P) - twice_mu);
}

/// P^-1 - 2 mu is positive definite exactly while this is below 1.
double breaking_scale(const Dense& root, const Eigen::VectorXd& mu) {
  const Dense middle = 2.0 * root.transpose() * Dense(mu.asDiagonal()) * root;
  return symmetric_eigen(middle).values.maxCoeff();
}

TEST_F(Numerics, InflateIsTheRiskSensitiveUpdateInInformationForm) {
  for (int k = 0; k < repetitions; ++k) {
    Square root = random_root();
    Column mu = random<n, 1>().cwiseAbs();
    mu *= 0.8 / breaking_scale(root, mu);
    const Dense expected = inflated(square(root), mu);
    ASSERT_TRUE((inflate_root<double, n>(root, mu)));
    EXPECT_TRUE(is_lower(root));
    expect_close(square(root), expected, 1e-11);
  }
}

/// (P^-1 - 2 mu)^-1 = L (I - 2 L^T mu L)^-1 L^T with P = L L^T, which needs no inverse of P.
TEST_F(Numerics, InflateStandsASingularCovariance) {
  for (int k = 0; k < repetitions; ++k) {
    Square root = random_root();
    root.col(2).setZero();
    root.col(5).setZero();
    Column mu = random<n, 1>().cwiseAbs();
    mu *= 0.8 / breaking_scale(root, mu);
    const Dense L = root, twice_mu = 2.0 * Dense(mu.asDiagonal());
    const Dense within = inverse(Dense::Identity(n, n) - L.transpose() * twice_mu * L);
    const Dense expected = L * within * L.transpose();
    ASSERT_TRUE((inflate_root<double, n>(root, mu)));
    expect_close(square(root), expected, 1e-11);
  }
}

TEST_F(Numerics, InflateByZeroIsTheIdentity) {
  const Square before = random_root();
  Square root = before;
  ASSERT_TRUE((inflate_root<double, n>(root, Column::Zero())));
  EXPECT_TRUE((root.array() == before.array()).all());
}

TEST_F(Numerics, InflateRefusesExactlyWhereTheInformationIsNotPositiveDefinite) {
  for (int k = 0; k < repetitions; ++k)
    for (const double margin : {1e-2, 1e-5, 1e-8, 1e-11}) {
      const Square before = random_root();
      Column mu = random<n, 1>().cwiseAbs();
      mu /= breaking_scale(before, mu);
      Square root = before;
      EXPECT_TRUE((inflate_root<double, n>(root, mu * (1.0 - margin)))) << margin;
      root = before;
      EXPECT_FALSE((inflate_root<double, n>(root, mu * (1.0 + margin)))) << margin;
      EXPECT_TRUE((root.array() == before.array()).all()) << "the root was touched";
    }
}

using Jet = ceres::Jet<double, 1>;

/// A + t B at t = 0, with its derivative by t.
template <int Rows, int Columns>
Matrix<Jet, Rows, Columns> line(const Matrix<double, Rows, Columns>& A,
                                const Matrix<double, Rows, Columns>& B) {
  Matrix<Jet, Rows, Columns> out = A.template cast<Jet>();
  for (int i = 0; i < A.size(); ++i) out(i).v[0] = B(i);
  return out;
}

Square derivative(const Matrix<Jet, n>& m) {
  return m.unaryExpr([](const Jet& j) { return j.v[0]; });
}

/// The derivative of L L^T is that of A A^T, also where an entry is zero and only passes through.
TEST_F(Numerics, LowerRootOnJetsHasTheDerivativeOfTheGramMatrix) {
  for (const bool zeros : {false, true}) {
    Matrix<double, n, n + 2> a = random<n, n + 2>();
    if (zeros) a.triangularView<Eigen::StrictlyUpper>().setZero();
    const auto jets = line<n, n + 2>(a, random<n, n + 2>());
    const Matrix<Jet, n> root = lower_root<Jet, n, n + 2>(jets);
    expect_close(derivative(root * root.transpose()), derivative(jets * jets.transpose()), 1e-11);
  }
}

TEST_F(Numerics, UpdateAndDowndateOnJetsHaveTheDerivativeOfTheOuterProduct) {
  for (const bool zeros : {false, true}) {
    const Square slope = random<n, n>().triangularView<Eigen::Lower>();
    Column v = 0.1 * random<n, 1>();
    if (zeros) v.head<3>().setZero();
    const auto jets = line<n, n>(random_root(), slope);
    const auto direction = line<n, 1>(v, random<n, 1>());
    const Matrix<Jet, n> P = jets * jets.transpose(), vv = direction * direction.transpose();
    Matrix<Jet, n> up = jets, down = jets;
    update_root<Jet, n>(up, direction);
    ASSERT_TRUE((downdate_root<Jet, n>(down, direction)));
    expect_close(derivative(up * up.transpose()), derivative(P + vv), 1e-11);
    expect_close(derivative(down * down.transpose()), derivative(P - vv), 1e-11);
  }
}

/// Whatever scales stand beside each other, and where the first pivot is zero.
TEST_F(Numerics, DividingWithFullPivotsSolves) {
  for (int k = 0; k < repetitions; ++k) {
    Matrix<double, 2> a = random<2, 2>();
    a.row(k % 2) *= std::pow(10.0, k % 13 - 6);
    if (k % 3 == 0) a(0, 0) = 0.0;
    const auto b = random<2, 3>();
    Matrix<double, 2, 3> x = b;
    ASSERT_TRUE((divide_with_full_pivots<double, 2, 3>(a, x)));
    const Dense left = Dense(a) * Dense(x);
    for (int i = 0; i < 2; ++i)
      EXPECT_LE((left.row(i) - b.row(i)).norm(), 1e-11 * Dense(a).row(i).norm() * Dense(x).norm());
  }
}

TEST_F(Numerics, DividingBySingularMatricesIsRefused) {
  for (int k = 0; k < repetitions; ++k) {
    const auto u = random<2, 1>(), v = random<2, 1>();
    Matrix<double, 2, 3> x = random<2, 3>();
    const Matrix<double, 2> outer(u * v.transpose());
    EXPECT_FALSE((divide_with_full_pivots<double, 2, 3>(outer, x)));
    EXPECT_FALSE((divide_with_full_pivots<double, 2, 3>(Matrix<double, 2>::Zero(), x)));
  }
}

TEST_F(Numerics, PropagationIsTheSimilarityByF) {
  const auto F = random<3, 3>();
  const auto a = random<3, 3>();
  Gaussian<double, 3> state{random<3, 1>(), a * a.transpose()};
  const auto before = state;
  propagate(state, F);
  const Dense f = F;
  expect_close(state.mean, f * Dense(before.mean));
  expect_close(state.covariance, f * Dense(before.covariance) * f.transpose());
}

TEST_F(Numerics, TheMeasurementUpdateAddsInformation) {
  for (int k = 0; k < repetitions; ++k) {
    const auto a = random<3, 3>();
    Gaussian<double, 3> state{random<3, 1>(), a * a.transpose() + Matrix<double, 3>::Identity()};
    const auto before = state;
    const auto H = random<2, 3>();
    const Matrix<double, 2> R = Vector<double, 2>(0.5, 2.0).asDiagonal();
    const Vector<double, 2> z = random<2, 1>();
    const auto innovation = measurement_update<double, 3, 2>(state, H, R, z);
    ASSERT_TRUE(innovation.sound);
    const Dense h = H, weight = inverse(R), prior = inverse(before.covariance);
    const Dense posterior = inverse(prior + h.transpose() * weight * h);
    const Dense x = before.mean, P = before.covariance;
    expect_close(state.covariance, posterior);
    expect_close(state.mean, posterior * (prior * x + h.transpose() * weight * Dense(z)));
    expect_close(innovation.value, Dense(z) - h * x);
    expect_close(innovation.covariance, h * P * h.transpose() + Dense(R));
  }
}

TEST_F(Numerics, MeasuringTheFirstStateIsTheGeneralUpdateWithAUnitRow) {
  for (int k = 0; k < repetitions; ++k) {
    const auto a = random<3, 3>();
    Gaussian<double, 3> general{random<3, 1>(), a * a.transpose()}, first = general;
    const double r = 0.3, z = random<1, 1>()(0);
    const Matrix<double, 1, 3> H(1.0, 0.0, 0.0);
    measurement_update<double, 3, 1>(general, H, Matrix<double, 1>(r), Vector<double, 1>(z));
    const auto innovation = measure_first(first, r, z);
    ASSERT_TRUE(innovation.sound);
    expect_close(first.mean, general.mean);
    expect_close(first.covariance, general.covariance);
  }
}

TEST_F(Numerics, ASingularInnovationLeavesTheStateUntouched) {
  Gaussian<double, 3> state{random<3, 1>(), Matrix<double, 3>::Zero()};
  const auto before = state;
  const Matrix<double, 1, 3> H(1.0, 0.0, 0.0);
  EXPECT_FALSE(
      (measurement_update<double, 3, 1>(state, H, Matrix<double, 1>::Zero(), Vector<double, 1>(1.0))
           .sound));
  EXPECT_FALSE(measure_first(state, 0.0, 1.0).sound);
  EXPECT_EQ(state.mean, before.mean);
  EXPECT_EQ(state.covariance, before.covariance);
}

/// Against the weighted sums over the points themselves, at q_i that are anything.
TEST_F(Numerics, TheQuadraticTransformIsTheSumOverAllSigmaPoints) {
  for (const double alpha : {1e-2, 0.1, 1.0, 2.0})
    for (const double beta : {0.0, 2.0})
      for (const double kappa : {-4.0, 0.0, 3.0}) {
        const reference::UnscentedWeights<double> w(n, alpha, beta, kappa);
        const Column q = random<n, 1>();
        const double pairs = w.spread * w.spread;
        double mean = 0.0, variance = 0.0;
        for (int i = 0; i < n; ++i) mean += 2.0 * w.other * pairs * q(i);
        for (int i = 0; i < n; ++i)
          variance += 2.0 * w.other * (pairs * q(i) - mean) * (pairs * q(i) - mean);
        const double size = variance + std::abs(w.covariance_centre) * mean * mean;
        variance += w.covariance_centre * mean * mean;
        EXPECT_NEAR(mean, q.sum(), 1e-12);
        EXPECT_NEAR((UnscentedQuadratic<double>(n, alpha, beta, kappa).variance<n>(q)), variance,
                    1e-12 * (1.0 + size));
      }
}

/// Products are summed in blocks that fit a cache: of this processor's, a fit would end elsewhere
/// in the last digits than on another.
TEST(Dense, BlocksOfProductsDoNotDependOnTheProcessor) {
  std::ptrdiff_t first = 0, second = 0, third = 0;
  Eigen::internal::manage_caching_sizes(Eigen::GetAction, &first, &second, &third);
  EXPECT_EQ(first, 32 * 1024);
  EXPECT_EQ(second, 1024 * 1024);
  EXPECT_EQ(third, 8 * 1024 * 1024);
  EXPECT_NEAR(solve_symmetric(Dense(2.0 * Dense::Identity(2, 2)), Dense(Dense::Ones(2, 1)))(0), 0.5,
              1e-15);
}

/// Of a turn, of what decays, and of a chain of derivatives, which is Taylor's series.
TEST(Dense, TheExponentialOfAMatrixIsKnownOfTurnsDecaysAndDerivatives) {
  Dense A = Dense::Zero(6, 6);
  A(0, 1) = 2.0;
  A(1, 0) = -2.0;
  A(2, 2) = -7.0;
  A(3, 4) = A(4, 5) = 3.0;
  const Dense E = matrix_exponential(A);
  EXPECT_NEAR(E(0, 0), std::cos(2.0), 1e-13);
  EXPECT_NEAR(E(0, 1), std::sin(2.0), 1e-13);
  EXPECT_NEAR(E(2, 2), std::exp(-7.0), 1e-13);
  EXPECT_NEAR(E(3, 5), 4.5, 1e-12);
  EXPECT_NEAR(E(3, 4), 3.0, 1e-12);
  EXPECT_NEAR(E(0, 2), 0.0, 1e-15);
}

TEST(SineOfTurns, IsThatOfLongDoubles) {
  NormalStream stream(1, 0, "sine_of_turns");
  for (const double size : {0.1, 1.0, 30.0, 1e5})
    for (std::uint64_t k = 0; k < 1000; ++k) {
      const double turns = size * stream.normal(k);
      const long double exact = std::sin(2.0L * std::numbers::pi_v<long double> *
                                         (static_cast<long double>(turns) - std::nearbyint(turns)));
      ASSERT_NEAR(sine_of_turns(turns), static_cast<double>(exact), 4e-16) << turns;
      ASSERT_EQ(within_a_turn(turns), turns - std::nearbyint(turns));
    }
  for (const double quarter : {0.0, 0.25, 0.5, 0.75, -0.25, 12.25})
    ASSERT_NEAR(sine_of_turns(quarter), std::sin(2.0 * std::numbers::pi * std::fmod(quarter, 1.0)),
                4e-16);
}

}  // namespace
}  // namespace gyrostat::numerics_test
