// What a gap is, and when nothing of it need be left.

#include <gyrostat/diagnosis/gap/scoring.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace gyrostat::gap::scoring_test {
namespace {

/// A reading that falls short by n nats lies z away, z^2 = 5 (exp(n / 3) - 1).
LogScore short_by(double z) {
  LogScore score;
  score.each = Eigen::VectorXd::Constant(4, -3.0 * std::log1p(z * z / 5.0));
  return score;
}

LogScore truth() {
  LogScore score;
  score.expected_each = Eigen::VectorXd::Zero(4);
  score.typical_shortfall = 4.0;
  score.rare_shortfall = 9.0;
  return score;
}

TEST(Scoring, AGapIsWhatNineOfTenReplicasHaveNot) {
  EXPECT_EQ(gap_of(short_by(1.9), truth()), 0.0);
  EXPECT_NEAR(gap_of(short_by(2.5), truth()), 1.5, 1e-12);
}

TEST(Scoring, AGapThatOneInFortyHasMayBeClosed) {
  EXPECT_TRUE(may_be_closed(short_by(2.9), truth()));
  EXPECT_FALSE(may_be_closed(short_by(3.1), truth()));
}

}  // namespace
}  // namespace gyrostat::gap::scoring_test
