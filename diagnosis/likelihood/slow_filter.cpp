#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace gyrostat::gap {
namespace {

constexpr int most_states = 16;
/// Up to so many states, a filter is compiled for each number.
constexpr int counted_states = 9;
constexpr std::size_t most_histories = 12;
const double log_two_pi = std::log(2.0 * std::numbers::pi);

/// How the states of a law move, for at most N of them: the level, then its decaying errors.
template <int N>
class Motion {
 public:
  explicit Motion(const SlowLaw& law)
      : white(law.white), states_(1 + std::min<int>(N - 1, static_cast<int>(law.parts.size()))) {
    decay_[0] = 1.0;
    drive_[0] = law.walk;
    double total = std::abs(law.white);
    for (int i = 1; i < states(); ++i) {
      const auto& part = law.parts[static_cast<std::size_t>(i - 1)];
      decay_[i] = part.decay;
      drive_[i] = part.variance * (1.0 - part.decay) * (1.0 + part.decay);
      first_variance[i] = part.variance;
      total += std::abs(part.variance);
    }
    first_variance[0] = 1e7 * (total + law.walk);
  }

  int states() const { return N <= counted_states ? N : states_; }
  /// What is left of each state after so many steps.
  std::array<double, N> decays(std::size_t steps) const {
    if (steps == 1) return decay_;
    std::array<double, N> left{};
    for (int i = 0; i < states(); ++i) left[i] = std::pow(decay_[i], static_cast<double>(steps));
    return left;
  }
  /// The variance that each state gains in them, given what is left of it.
  std::array<double, N> drives(std::size_t steps, const std::array<double, N>& left) const {
    std::array<double, N> gained = drive_;
    gained[0] = drive_[0] * static_cast<double>(steps);
    for (int i = 1; i < states() && steps != 1; ++i)
      gained[i] = first_variance[i] * (1.0 - left[i] * left[i]);
    return gained;
  }

  double white;
  std::array<double, N> first_variance{};

 private:
  int states_;
  std::array<double, N> decay_{}, drive_{};
};

/// The covariance recursion, the same for every series that is filtered.
template <int N>
class Recursion {
 public:
  explicit Recursion(const SlowLaw& law) : motion_(law) {
    for (int i = 0; i < states(); ++i) at(i, i) = motion_.first_variance[i];
  }

  int states() const { return motion_.states(); }
  const Motion<N>& motion() const { return motion_; }
  const std::array<double, N>& gain() const { return gain_; }
  /// Variance of the innovation.
  double variance() const { return innovation_; }
  double log_variance() const { return log_innovation_; }

  void predict(std::size_t steps) {
    if (settled_ && steps == 1) return;
    settled_ = false;
    const auto left = motion_.decays(steps), gained = motion_.drives(steps, left);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) at(i, j) *= left[i] * left[j];
    for (int i = 0; i < states(); ++i) at(i, i) += gained[i];
    one_step_ = steps == 1;
  }
  void update() {
    if (settled_) return;
    double innovation = motion_.white;
    std::array<double, N> row{};
    for (int i = 0; i < states(); ++i) {
      for (int j = 0; j < states(); ++j) row[i] += at(i, j);
      innovation += row[i];
    }
    // Settled once nothing moves any more: the gains of a long even stretch are constant.
    double moved = std::abs(innovation - innovation_) / innovation;
    for (int i = 0; i < states(); ++i) {
      const double gain = row[i] / innovation;
      moved = std::max(moved, std::abs(gain - gain_[i]));
      gain_[i] = gain;
    }
    innovation_ = innovation;
    log_innovation_ = std::log(innovation);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) at(i, j) -= gain_[i] * row[j];
    settled_ = one_step_ && moved < 1e-9;
  }

 private:
  double& at(int i, int j) { return covariance_[i * N + j]; }

  Motion<N> motion_;
  std::array<double, N> gain_{};
  std::array<double, N * N> covariance_{};
  double innovation_ = 0.0, log_innovation_ = 0.0;
  bool one_step_ = false, settled_ = false;
};

/// The state of one filtered series.
template <int N>
struct Estimate {
  std::array<double, N> state{};

  void predict(const std::array<double, N>& left, int states) {
    for (int i = 1; i < states; ++i) state[i] *= left[i];
  }
  double expected(int states) const {
    double sum = 0.0;
    for (int i = 0; i < states; ++i) sum += state[i];
    return sum;
  }
  void update(const Recursion<N>& r, double innovation) {
    for (int i = 0; i < r.states(); ++i) state[i] += r.gain()[i] * innovation;
  }
};

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

template <int N>
SlowTerms gaussian_terms(const SlowLaw& law, std::span<const std::size_t> points,
                         const Eigen::VectorXd& values, const Eigen::MatrixXd& regressors,
                         const Eigen::VectorXd& prior_std) {
  const auto count = static_cast<std::size_t>(values.size());
  const auto columns = static_cast<std::size_t>(regressors.cols());
  Recursion<N> recursion(law);
  const auto left_in_one = recursion.motion().decays(1);
  auto left_of_states = left_in_one;
  std::vector<Estimate<N>> estimates(columns + 1);
  Eigen::MatrixXd white(values.size(), regressors.cols() + 1);
  SlowTerms terms;
  terms.log_variances.reserve(count);
  double logs = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (k > 0) {
      const std::size_t steps = points[k] - points[k - 1];
      recursion.predict(steps);
      if (steps != 1) left_of_states = recursion.motion().decays(steps);
      for (auto& e : estimates)
        e.predict(steps == 1 ? left_in_one : left_of_states, recursion.states());
    }
    recursion.update();
    const double deviation = std::sqrt(recursion.variance());
    for (std::size_t c = 0; c <= columns; ++c) {
      const double value = c == 0 ? values[row] : regressors(row, static_cast<Eigen::Index>(c) - 1);
      const double innovation = value - estimates[c].expected(recursion.states());
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

/// Histories of jumps side by side: of each a lane, with the likelihood so far, the level (of two:
/// +1 or -1 times half their distance) and what it makes of the states. What each does is what a
/// Recursion and an Estimate of its own would.
template <int N>
class Histories {
 public:
  static constexpr std::size_t lanes = 16;
  static_assert(lanes >= most_histories + 2);
  using Lanes = std::array<double, lanes>;

  /// Those of a change between two levels leave what is known of the states as it is: they share
  /// one recursion.
  Histories(const SlowLaw& still, const Jumps& jumps)
      : common_(still), is_of_two_(jumps.to == Jumps::To::the_other_level) {
    size_ = is_of_two_ ? 2 : 1;
    for (std::size_t h = 0; h < size_; ++h) {
      log_weight_[h] = is_of_two_ ? std::log(0.5) : 0.0;
      level_[h] = is_of_two_ ? (h == 0 ? -jumps.size_dps : jumps.size_dps) : 0.0;
      for (int i = 0; i < states(); ++i) at(i, i)[h] = motion().first_variance[i];
    }
  }

  /// From one value to the next: each history goes on, and of the likeliest on each level one is
  /// born that jumps now.
  void predict(std::size_t steps, const Jumps& jumps, double interval_s) {
    if (steps != steps_) {
      const double mean = jumps.per_s * interval_s * static_cast<double>(steps);
      const double jump = is_of_two_ ? 0.5 * -std::expm1(-2.0 * mean) : -std::expm1(-mean);
      log_jump_ = std::log(jump);
      log_none_ = std::log1p(-jump);
      left_ = motion().decays(steps);
      gained_ = motion().drives(steps, left_);
      steps_ = steps;
    }
    if (is_of_two_)
      common_.predict(steps);
    else
      predict_covariances();
    for (int i = 1; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) state_[i][h] *= left_[i];
    const std::size_t before = size_;
    if (is_of_two_)
      for (const double from : {-jumps.size_dps, jumps.size_dps}) bear(before, from, 0.0);
    else
      bear(before, 0.0, jumps.size_dps * jumps.size_dps);
    for (std::size_t h = 0; h < before; ++h) log_weight_[h] += log_none_;
  }

  /// Takes a value in; the first one tells nothing of the weights.
  void update(double value, bool is_first) {
    if (is_of_two_)
      common_.update();
    else
      update_covariances();
    Lanes expected{};
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) expected[h] += state_[i][h];
    Lanes innovation;
    for (std::size_t h = 0; h < lanes; ++h) innovation[h] = value - level_[h] - expected[h];
    for (int i = 0; i < states(); ++i)
      if (is_of_two_)
        for (std::size_t h = 0; h < lanes; ++h) state_[i][h] += common_.gain()[i] * innovation[h];
      else
        for (std::size_t h = 0; h < lanes; ++h) state_[i][h] += gain_[i][h] * innovation[h];
    if (is_first) return;
    for (std::size_t h = 0; h < size_; ++h) {
      const double variance = is_of_two_ ? common_.variance() : variance_[h];
      const double log_variance = is_of_two_ ? common_.log_variance() : log_variance_[h];
      log_weight_[h] -=
          0.5 * (log_two_pi + log_variance + innovation[h] * innovation[h] / variance);
    }
  }

  /// Makes the weights add up to 1, and returns the logarithm of what they added up to.
  double normalise() {
    double most = -1e300;
    for (std::size_t h = 0; h < size_; ++h) most = std::max(most, log_weight_[h]);
    double total = 0.0;
    for (std::size_t h = 0; h < size_; ++h) total += std::exp(log_weight_[h] - most);
    const double by = most + std::log(total);
    for (std::size_t h = 0; h < size_; ++h) log_weight_[h] -= by;
    return by;
  }

  void keep_the_likeliest() {
    while (size_ > most_histories) {
      const auto last = log_weight_.begin() + static_cast<std::ptrdiff_t>(size_);
      const auto least = static_cast<std::size_t>(std::min_element(log_weight_.begin(), last) -
                                                  log_weight_.begin());
      --size_;
      if (least != size_) copy(size_, least);
    }
  }

 private:
  const Motion<N>& motion() const { return common_.motion(); }
  int states() const { return common_.states(); }
  Lanes& at(int i, int j) { return covariance_[static_cast<std::size_t>(i * N + j)]; }

  void copy(std::size_t from, std::size_t to) {
    log_weight_[to] = log_weight_[from];
    level_[to] = level_[from];
    for (int i = 0; i < states(); ++i) state_[i][to] = state_[i][from];
    if (is_of_two_) return;
    variance_[to] = variance_[from];
    log_variance_[to] = log_variance_[from];
    settled_[to] = settled_[from];
    for (int i = 0; i < states(); ++i) {
      gain_[i][to] = gain_[i][from];
      for (int j = 0; j < states(); ++j) at(i, j)[to] = at(i, j)[from];
    }
  }

  /// Of the first `among`, the likeliest on a level has a child.
  void bear(std::size_t among, double from, double widened_by) {
    std::size_t parent = among;
    double share = 0.0;
    for (std::size_t h = 0; h < among; ++h) {
      if (level_[h] != from) continue;
      if (parent == among || log_weight_[h] > log_weight_[parent]) parent = h;
      share += std::exp(log_weight_[h]);
    }
    if (parent == among) return;
    const std::size_t child = size_++;
    copy(parent, child);
    log_weight_[child] = std::log(std::max(share, 1e-300)) + log_jump_;
    level_[child] = -from;
    if (is_of_two_) return;
    at(0, 0)[child] += widened_by;
    settled_[child] = 0.0;
  }

  void predict_covariances() {
    if (steps_ != 1) settled_.fill(0.0);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) {
        auto& covariance = at(i, j);
        const double left = left_[i] * left_[j], gained = i == j ? gained_[i] : 0.0;
        for (std::size_t h = 0; h < lanes; ++h) {
          const double next = i == j ? covariance[h] * left + gained : covariance[h] * left;
          covariance[h] = settled_[h] != 0.0 ? covariance[h] : next;
        }
      }
  }

  void update_covariances() {
    std::array<Lanes, N> row{};
    Lanes innovation, moved;
    innovation.fill(motion().white);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j)
        for (std::size_t h = 0; h < lanes; ++h) row[i][h] += at(i, j)[h];
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) innovation[h] += row[i][h];
    for (std::size_t h = 0; h < lanes; ++h)
      moved[h] = std::abs(innovation[h] - variance_[h]) / innovation[h];
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) {
        const double gain = row[i][h] / innovation[h], by = std::abs(gain - gain_[i][h]);
        moved[h] = moved[h] < by ? by : moved[h];
        gain_[i][h] = settled_[h] != 0.0 ? gain_[i][h] : gain;
      }
    for (std::size_t h = 0; h < size_; ++h)
      if (settled_[h] == 0.0) log_variance_[h] = std::log(innovation[h]);
    for (std::size_t h = 0; h < lanes; ++h)
      variance_[h] = settled_[h] != 0.0 ? variance_[h] : innovation[h];
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) {
        auto& covariance = at(i, j);
        for (std::size_t h = 0; h < lanes; ++h) {
          const double next = covariance[h] - gain_[i][h] * row[j][h];
          covariance[h] = settled_[h] != 0.0 ? covariance[h] : next;
        }
      }
    for (std::size_t h = 0; h < lanes; ++h)
      settled_[h] = settled_[h] != 0.0 || (steps_ == 1 && moved[h] < 1e-9) ? 1.0 : 0.0;
  }

  Recursion<N> common_;
  bool is_of_two_;
  std::size_t size_ = 0, steps_ = 0;
  double log_jump_ = 0.0, log_none_ = 0.0;
  std::array<double, N> left_{}, gained_{};
  alignas(64) Lanes log_weight_{}, level_{}, variance_{}, log_variance_{}, settled_{};
  std::array<Lanes, N> state_{}, gain_{};
  std::array<Lanes, N * N> covariance_{};
};

template <int N>
double jump_log_likelihood(const SlowLaw& law, std::span<const std::size_t> points,
                           const Eigen::VectorXd& values) {
  SlowLaw still = law;
  still.jumps.reset();
  Histories<N> histories(still, *law.jumps);
  double total = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0) histories.predict(points[k] - points[k - 1], *law.jumps, law.interval_s);
    histories.update(values[static_cast<Eigen::Index>(k)], k == 0);
    total += histories.normalise();
    histories.keep_the_likeliest();
  }
  return total;
}

/// Calls with the least number of states (std::integral_constant) that the law's recursion needs.
template <int N = 1, class Call>
auto with_room_for(const SlowLaw& law, Call&& call) {
  if constexpr (N <= counted_states) {
    if (law.parts.size() + 1 == N) return call(std::integral_constant<int, N>{});
    return with_room_for<N + 1>(law, std::forward<Call>(call));
  } else {
    return call(std::integral_constant<int, most_states>{});
  }
}

}  // namespace

SlowTerms slow_terms(const SlowLaw& law, std::span<const std::size_t> points,
                     const Eigen::VectorXd& values, const Eigen::MatrixXd& regressors,
                     const Eigen::VectorXd& prior_std) {
  const SlowLaw gaussian = without_jumps(law);
  auto terms = with_room_for(gaussian, [&](auto states) {
    return gaussian_terms<states.value>(gaussian, points, values, regressors, prior_std);
  });
  if (!law.jumps) return terms;
  Eigen::VectorXd left = values;
  if (regressors.cols() > 0) left -= regressors * terms.coefficients;
  terms.log_likelihood = with_room_for(
      law, [&](auto states) { return jump_log_likelihood<states.value>(law, points, left); });
  terms.log_likelihood -= terms.cost_of_coefficients;
  return terms;
}

}  // namespace gyrostat::gap
