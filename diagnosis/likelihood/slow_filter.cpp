#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/likelihood/histories/kernels.hpp>
#include <gyrostat/diagnosis/likelihood/slow_recursion.hpp>

namespace gyrostat::gap {
namespace {

SlowLaw without_jumps(SlowLaw law) {
  if (!law.jumps) return law;
  const double square = law.jumps->size_dps * law.jumps->size_dps;
  if (law.jumps->to == Jumps::To::the_other_level)
    law.parts.push_back({square, std::exp(-2.0 * law.jumps->per_s * law.interval_s)});
  else
    law.walk += square * law.jumps->per_s * law.interval_s;
  law.jumps.reset();
  return law;
}

/// `jumps_by`, where there are any, is the variance that the level gains before each value besides.
template <int N>
SlowTerms gaussian_terms(const SlowLaw& law, std::span<const std::size_t> points,
                         const Eigen::VectorXd& values, const Eigen::MatrixXd& regressors,
                         const Eigen::VectorXd& prior_std, std::span<const double> jumps_by) {
  const auto count = static_cast<std::size_t>(values.size());
  const auto columns = static_cast<std::size_t>(regressors.cols());
  SlowRecursion<N> recursion(law);
  const auto left_in_one = recursion.motion().decays(1);
  auto left_of_states = left_in_one;
  std::vector<SlowEstimate<N>> estimates(columns + 1);
  Eigen::MatrixXd white(values.size(), regressors.cols() + 1);
  SlowTerms terms;
  terms.log_variances.reserve(count);
  double logs = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (k > 0) {
      const std::size_t steps = points[k] - points[k - 1];
      recursion.predict(steps);
      if (!jumps_by.empty()) recursion.jump(jumps_by[k]);
      if (steps != 1) left_of_states = recursion.motion().decays(steps);
      for (auto& e : estimates)
        e.predict(steps == 1 ? left_in_one : left_of_states, recursion.states());
    }
    recursion.update();
    const double deviation = std::sqrt(recursion.variance());
    for (std::size_t c = 0; c <= columns; ++c) {
      const double value = c == 0 ? values[row] : regressors(row, static_cast<Eigen::Index>(c) - 1);
      const double innovation = value - estimates[c].expected(recursion);
      estimates[c].update(recursion, innovation);
      white(row, static_cast<Eigen::Index>(c)) = innovation / deviation;
    }
    terms.log_variances.push_back(recursion.log_variance());
    if (k > 0) logs += terms.log_variances.back();
  }
  const Eigen::Index rows = values.size() - 1;
  Eigen::VectorXd left = white.col(0).tail(rows);
  if (columns > 0) {
    const auto x = white.bottomRightCorner(rows, regressors.cols());
    // In units of the priors: det(1 + S X' V^-1 X S) is what not knowing the coefficients costs.
    const Eigen::MatrixXd scaled = x * prior_std.asDiagonal();
    Eigen::MatrixXd normal = scaled.transpose() * scaled;
    normal.diagonal().array() += 1.0;
    const auto [inverse, pivots, positive] = invert_symmetric(normal);
    const Eigen::VectorXd units =
        solve_symmetric(normal, Eigen::VectorXd(scaled.transpose() * left));
    terms.coefficients = prior_std.cwiseProduct(units);
    terms.coefficients_std = prior_std.cwiseProduct(inverse.diagonal().cwiseMax(0.0).cwiseSqrt());
    left -= scaled * units;
    terms.cost_of_coefficients = 0.5 * (pivots.array().log().sum() + units.squaredNorm());
    logs += 2.0 * terms.cost_of_coefficients;
  }
  terms.innovations.assign(left.begin(), left.end());
  terms.log_variances.erase(terms.log_variances.begin());
  terms.log_likelihood =
      -0.5 * (logs + left.squaredNorm() + static_cast<double>(rows) * log_two_pi);
  return terms;
}

/// The histories of a law's jumps on values, and what they say of each.
struct Jumped {
  double log_likelihood;
  std::vector<double> said;
};

Jumped followed(const SlowLaw& law, std::span<const std::size_t> points,
                const Eigen::VectorXd& values, bool says_of_each) {
  SlowLaw still = law;
  still.jumps.reset();
  const SlowMotion<most_states> motion(still);
  const auto decay = motion.decays(1), drive = motion.drives(1, decay);
  const JumpLaw in_numbers{.white = law.white,
                           .interval_s = law.interval_s,
                           .jumps_per_s = law.jumps->per_s,
                           .jump_dps = law.jumps->size_dps,
                           .is_of_two = law.jumps->to == Jumps::To::the_other_level,
                           .states = motion.states(),
                           .decay = decay.data(),
                           .drive = drive.data(),
                           .first_variance = motion.first_variance.data()};
  Jumped found{.log_likelihood = 0.0, .said = {}};
  if (says_of_each) found.said.resize(points.size());
  found.log_likelihood =
      jump_kernel().follow(in_numbers, points.data(), values.data(), points.size(),
                           says_of_each ? found.said.data() : nullptr);
  return found;
}

/// Calls with the least number of states (std::integral_constant) that the law's recursion needs.
template <int N = 1, class Call>
auto with_room_for(const SlowLaw& law, Call&& call) {
  if constexpr (N <= counted_states) {
    if (states_of(law) == N) return call(std::integral_constant<int, N>{});
    return with_room_for<N + 1>(law, std::forward<Call>(call));
  } else {
    return call(std::integral_constant<int, most_states>{});
  }
}

SlowTerms gaussian_terms_of(const SlowLaw& law, std::span<const std::size_t> points,
                            const Eigen::VectorXd& values, const Eigen::MatrixXd& regressors,
                            const Eigen::VectorXd& prior_std,
                            std::span<const double> jumps_by = {}) {
  return with_room_for(law, [&](auto states) {
    return gaussian_terms<states.value>(law, points, values, regressors, prior_std, jumps_by);
  });
}

/// Variance of a settled innovation of a level that walks (Harvey 1989, 4.1.2).
double settled_variance(const SlowLaw& law) {
  const double root = std::sqrt(std::max(0.0, law.walk * (law.walk + 4.0 * law.white)));
  return law.white + 0.5 * (law.walk + root);
}

/// The coefficients with what not knowing them costs, given what histories say. A level that has
/// jumped with probability p is known as well as histories know it on average: their precisions
/// are averaged, not their variances, or many unlikely jumps would spread a level that none moved.
SlowTerms beside_jumps(const SlowLaw& law, const std::vector<double>& said,
                       std::span<const std::size_t> points, const Eigen::VectorXd& values,
                       const Eigen::MatrixXd& regressors, const Eigen::VectorXd& prior_std) {
  const double size = law.jumps->size_dps;
  SlowLaw still = law;
  still.jumps.reset();
  if (law.jumps->to == Jumps::To::another_level) {
    const double knows = 1.0 / settled_variance(still), knew = 1.0 / (1.0 / knows + size * size);
    std::vector<double> by;
    by.reserve(said.size());
    for (const double p : said) by.push_back(1.0 / (knows + p * (knew - knows)) - 1.0 / knows);
    return gaussian_terms_of(still, points, values, regressors, prior_std, by);
  }
  // Of two levels, what is known of them is taken away, and what is not stays noise.
  double unknown = 0.0;
  for (const double level : said) unknown += 1.0 - level * level;
  unknown /= static_cast<double>(said.size());
  Eigen::VectorXd rest = values;
  for (std::size_t k = 0; k < said.size(); ++k)
    rest[static_cast<Eigen::Index>(k)] -= (1.0 - unknown) * size * said[k];
  SlowLaw faint = law;
  faint.jumps->size_dps *= std::sqrt(unknown);
  return gaussian_terms_of(without_jumps(faint), points, rest, regressors, prior_std);
}

}  // namespace

SlowTerms slow_terms(const SlowLaw& law, std::span<const std::size_t> points,
                     const Eigen::VectorXd& values, const Eigen::MatrixXd& regressors,
                     const Eigen::VectorXd& prior_std, const SlowTerms* near, bool is_the_last) {
  const bool goes_on = law.jumps && near != nullptr && !near->said.empty();
  auto terms = goes_on
                   ? beside_jumps(law, near->said, points, values, regressors, prior_std)
                   : gaussian_terms_of(without_jumps(law), points, values, regressors, prior_std);
  if (!law.jumps) return terms;
  const auto follow = [&] {
    Eigen::VectorXd left = values;
    if (regressors.cols() > 0) left -= regressors * terms.coefficients;
    return followed(law, points, left, !is_the_last || !goes_on);
  };
  auto histories = follow();
  constexpr int passes = 3;
  for (int pass = 0; pass < passes && regressors.cols() > 0 && !goes_on; ++pass) {
    terms = beside_jumps(law, histories.said, points, values, regressors, prior_std);
    histories = follow();
  }
  terms.log_likelihood = histories.log_likelihood - terms.cost_of_coefficients;
  terms.said = std::move(histories.said);
  return terms;
}

}  // namespace gyrostat::gap
