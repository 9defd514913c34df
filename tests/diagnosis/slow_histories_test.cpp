// Jumps too faint to be seen one by one against the density of the level on a grid.

#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/likelihood/histories/kernels.hpp>

namespace gyrostat::gap::slow_histories_test {
namespace {

/// Means of white noise of variance 1 about a level that jumps each by itself too faintly to see.
Eigen::VectorXd faint_jumps(const Jumps& jumps, std::uint64_t seed) {
  const Eigen::Index count = 1500;
  const NormalStream noise(seed, 0, "noise"), sizes(seed, 0, "sizes"), chance(seed, 0, "chance");
  Eigen::VectorXd values(count);
  double level = jumps.to == Jumps::To::the_other_level ? jumps.size_dps : 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto index = static_cast<std::uint64_t>(k);
    if (chance.uniform(index) < jumps.per_s)
      level = jumps.to == Jumps::To::the_other_level ? -level
                                                     : level + jumps.size_dps * sizes.normal(index);
    values[k] = level + noise.normal(index);
  }
  return values;
}

/// Exact, with the level's density on a grid: its mean weight is the likelihood of a level of which
/// nothing was known.
double log_likelihood_on_a_grid(const Jumps& jumps, const Eigen::VectorXd& values) {
  const bool is_of_two = jumps.to == Jumps::To::the_other_level;
  const double spacing = is_of_two ? 0.02 : 0.1, reach = is_of_two ? 4.0 : 15.0;
  const auto cells = static_cast<Eigen::Index>(std::lround(2.0 * reach / spacing)) + 1;
  const Eigen::VectorXd level = Eigen::VectorXd::LinSpaced(cells, -reach, reach);
  // Of two levels, the middle is what nothing is known of; else, the level itself.
  const double jump = is_of_two ? 0.5 * -std::expm1(-2.0 * jumps.per_s) : -std::expm1(-jumps.per_s);
  Eigen::MatrixXd to(cells, cells);
  if (!is_of_two)
    for (Eigen::Index i = 0; i < cells; ++i)
      for (Eigen::Index j = 0; j < cells; ++j)
        to(i, j) = spacing / (jumps.size_dps * std::sqrt(2.0 * std::numbers::pi)) *
                   std::exp(-0.5 * std::pow((level[i] - level[j]) / jumps.size_dps, 2));
  Eigen::MatrixXd weight = Eigen::MatrixXd::Constant(cells, 2, 0.5);
  double log_likelihood = 0.0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (k > 0) {
      const Eigen::MatrixXd jumped =
          is_of_two ? Eigen::MatrixXd(weight.rowwise().reverse()) : Eigen::MatrixXd(to * weight);
      weight = (1.0 - jump) * weight + jump * jumped;
    }
    for (Eigen::Index side = 0; side < 2; ++side) {
      const double offset = is_of_two ? (side == 0 ? -jumps.size_dps : jumps.size_dps) : 0.0;
      const Eigen::ArrayXd off = values[k] - offset - level.array();
      weight.col(side).array() *= (-0.5 * off.square()).exp() / std::sqrt(2.0 * std::numbers::pi);
    }
    const double total = weight.sum() * spacing;
    weight /= total;
    if (k > 0) log_likelihood += std::log(total);
  }
  return log_likelihood;
}

/// Followed by the likeliest histories alone, such jumps would lose 20 to 60 nats, and noise of the
/// same covariance would always win. What merging loses spreads by 0.5 nats over 80 other draws
/// (the most 1.7).
TEST(JumpHistories, FollowsManyFaintJumpsAsAGridOfLevelsDoes) {
  for (const Jumps& jumps : {Jumps{Jumps::To::the_other_level, 0.5, 1.0 / 20.0},
                             Jumps{Jumps::To::another_level, 0.7, 1.0 / 60.0}})
    for (const std::uint64_t seed : {1, 2}) {
      const Eigen::VectorXd values = faint_jumps(jumps, seed);
      std::vector<std::size_t> each(static_cast<std::size_t>(values.size()));
      std::iota(each.begin(), each.end(), std::size_t{0});
      const SlowLaw law{.white = 1.0, .walk = 0.0, .parts = {}, .jumps = jumps};
      const auto terms =
          slow_terms(law, each, values, Eigen::MatrixXd(values.size(), 0), Eigen::VectorXd());
      EXPECT_NEAR(terms.log_likelihood, log_likelihood_on_a_grid(jumps, values), 2.5);
    }
}

/// The bits are every machine's: those of the widest instruction set are those of the narrowest.
TEST(JumpHistories, AreTheSameForEveryInstructionSet) {
  constexpr std::array<std::size_t, 5> states = {1, 2, 3, 7, 16};
  const double decay[most_states] = {1.0, 0.9, 0.99, 0.5, 0.7, 0.8,  0.95, 0.97,
                                     0.1, 0.2, 0.3,  0.4, 0.6, 0.65, 0.85, 0.75};
  double drive[most_states], first[most_states];
  for (int i = 0; i < most_states; ++i) {
    drive[i] = 1e-3;
    first[i] = i == 0 ? 1e7 : 1e-3 / (1.0 - decay[i] * decay[i]);
  }
  for (const auto to : {Jumps::To::the_other_level, Jumps::To::another_level}) {
    const Jumps jumps{to, 0.7, 1.0 / 60.0};
    const auto values = faint_jumps(jumps, 3);
    const auto count = static_cast<std::size_t>(values.size());
    std::vector<std::size_t> points(count);
    for (std::size_t k = 0; k < count; ++k) points[k] = k + k / 100;
    for (const std::size_t room : states) {
      const JumpLaw law{.white = 1.0,
                        .interval_s = 1.0,
                        .jumps_per_s = jumps.per_s,
                        .jump_dps = jumps.size_dps,
                        .is_of_two = to == Jumps::To::the_other_level,
                        .states = static_cast<int>(room),
                        .decay = decay,
                        .drive = drive,
                        .first_variance = first};
      std::vector<std::vector<double>> each;
      for (const auto* kernels : available_kernels()) {
        each.emplace_back(count);
        const auto& kernel = jump_kernel(kernels->target);
        const double by =
            kernel.follow(law, points.data(), values.data(), count, each.back().data());
        EXPECT_EQ(kernel.follow(law, points.data(), values.data(), count, nullptr), by);
        each.back().push_back(by);
        EXPECT_EQ(each.back(), each.front()) << kernels->target;
      }
    }
  }
}

/// Levels so far apart that after a value on one of them the other's weight is among the least
/// numbers that there are, which have no reciprocal: about 720 nats, for some of the sizes.
TEST(JumpHistories, ALevelThatIsHardlyPossibleHasAFiniteLikelihood) {
  const Eigen::Index count = 200;
  const NormalStream noise(6, 0, "noise");
  std::vector<std::size_t> each(count);
  std::iota(each.begin(), each.end(), std::size_t{0});
  for (double size = 0.8; size < 1.2; size += 0.005) {
    Eigen::VectorXd values(count);
    for (Eigen::Index k = 0; k < count; ++k)
      values[k] = (k < 20 ? -size : size) + 0.01 * noise.normal(static_cast<std::uint64_t>(k));
    const SlowLaw law{.white = 2.5e-3,
                      .walk = 1e-5,
                      .parts = {},
                      .jumps = Jumps{Jumps::To::the_other_level, size, 0.01}};
    const auto terms = slow_terms(law, each, values, Eigen::MatrixXd(count, 0), Eigen::VectorXd());
    EXPECT_TRUE(std::isfinite(terms.log_likelihood)) << size;
  }
}

/// A value far off leaves nothing of the histories without a jump there, and the next one is as
/// they say.
TEST(JumpHistories, AValueThatNoJumpExplainsHasAFiniteLikelihood) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(200);
  values[100] = 1e3;
  std::vector<std::size_t> each(200);
  std::iota(each.begin(), each.end(), std::size_t{0});
  for (const auto to : {Jumps::To::the_other_level, Jumps::To::another_level}) {
    const SlowLaw law{.white = 1.0, .walk = 0.0, .parts = {}, .jumps = Jumps{to, 1.0, 1e-4}};
    const auto terms = slow_terms(law, each, values, Eigen::MatrixXd(200, 0), Eigen::VectorXd());
    EXPECT_TRUE(std::isfinite(terms.log_likelihood));
    EXPECT_LT(terms.log_likelihood, -1e5);
  }
}

}  // namespace
}  // namespace gyrostat::gap::slow_histories_test
