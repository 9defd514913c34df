#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include <Eigen/Cholesky>

namespace gyrostat::gap {
namespace {

constexpr int most_states = 16;
constexpr int few_states = 2;  ///< enough for a level and one decaying error
constexpr int some_states = 4;
constexpr std::size_t most_histories = 12;
const double log_two_pi = std::log(2.0 * std::numbers::pi);

/// The covariance recursion, the same for every series that is filtered, for at most N states.
template <int N>
class Recursion {
 public:
  explicit Recursion(const SlowLaw& law)
      : states_(1 + std::min<int>(N - 1, static_cast<int>(law.parts.size()))), white_(law.white) {
    decay_[0] = 1.0;
    drive_[0] = law.walk;
    double total = law.white;
    for (int i = 1; i < states_; ++i) {
      const auto& part = law.parts[static_cast<std::size_t>(i - 1)];
      decay_[i] = part.decay;
      drive_[i] = part.variance * (1.0 - part.decay) * (1.0 + part.decay);
      variance_[i] = part.variance;
      total += part.variance;
    }
    for (int i = 0; i < states_; ++i) at(i, i) = i == 0 ? 1e7 * (total + law.walk) : variance_[i];
  }

  int states() const { return states_; }
  double decay(int i, std::size_t steps) const {
    return steps == 1 ? decay_[i] : std::pow(decay_[i], static_cast<double>(steps));
  }
  const std::array<double, N>& gain() const { return gain_; }
  /// Variance of the innovation.
  double variance() const { return innovation_; }
  double log_variance() const { return log_innovation_; }
  void widen_level(double by) { at(0, 0) += by, settled_ = false; }

  void predict(std::size_t steps) {
    if (settled_ && steps == 1) return;
    settled_ = false;
    std::array<double, N> f{};
    for (int i = 0; i < states_; ++i) f[i] = decay(i, steps);
    for (int i = 0; i < states_; ++i)
      for (int j = 0; j < states_; ++j) at(i, j) *= f[i] * f[j];
    at(0, 0) += drive_[0] * static_cast<double>(steps);
    for (int i = 1; i < states_; ++i)
      at(i, i) += steps == 1 ? drive_[i] : variance_[i] * (1.0 - f[i] * f[i]);
    one_step_ = steps == 1;
  }
  void update() {
    if (settled_) return;
    double innovation = white_;
    std::array<double, N> row{};
    for (int i = 0; i < states_; ++i) {
      for (int j = 0; j < states_; ++j) row[i] += at(i, j);
      innovation += row[i];
    }
    // Settled once nothing moves any more: the gains of a long even stretch are constant.
    double moved = std::abs(innovation - innovation_) / innovation;
    for (int i = 0; i < states_; ++i) {
      const double gain = row[i] / innovation;
      moved = std::max(moved, std::abs(gain - gain_[i]));
      gain_[i] = gain;
    }
    innovation_ = innovation;
    log_innovation_ = std::log(innovation);
    for (int i = 0; i < states_; ++i)
      for (int j = 0; j < states_; ++j) at(i, j) -= gain_[i] * row[j];
    settled_ = one_step_ && moved < 1e-9;
  }

 private:
  double& at(int i, int j) { return covariance_[i * N + j]; }

  int states_;
  double white_;
  std::array<double, N> decay_{}, drive_{}, variance_{}, gain_{};
  std::array<double, N * N> covariance_{};
  double innovation_ = 0.0, log_innovation_ = 0.0;
  bool one_step_ = false, settled_ = false;
};

/// The state of one filtered series.
template <int N>
struct Estimate {
  std::array<double, N> state{};

  void predict(const Recursion<N>& r, std::size_t steps) {
    for (int i = 1; i < r.states(); ++i) state[i] *= r.decay(i, steps);
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
  std::vector<Estimate<N>> estimates(columns + 1);
  Eigen::MatrixXd white(values.size(), regressors.cols() + 1);
  SlowTerms terms;
  double logs = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (k > 0) {
      const std::size_t steps = points[k] - points[k - 1];
      recursion.predict(steps);
      for (auto& e : estimates) e.predict(recursion, steps);
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
    const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
    const Eigen::VectorXd units = solver.solve(scaled.transpose() * left);
    terms.coefficients = prior_std.cwiseProduct(units);
    const Eigen::MatrixXd inverse =
        solver.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
    terms.coefficients_std = prior_std.cwiseProduct(inverse.diagonal().cwiseMax(0.0).cwiseSqrt());
    left -= scaled * units;
    terms.cost_of_coefficients = 0.5 * (solver.vectorD().array().log().sum() + units.squaredNorm());
    logs += 2.0 * terms.cost_of_coefficients;
  }
  terms.innovations.assign(left.begin(), left.end());
  terms.log_variances.erase(terms.log_variances.begin());
  terms.log_likelihood =
      -0.5 * (logs + left.squaredNorm() + static_cast<double>(rows) * log_two_pi);
  return terms;
}

/// One history of jumps, with what it makes of the state.
template <int N>
struct History {
  double log_weight;
  Recursion<N> recursion;
  Estimate<N> estimate;
  double level;  ///< on which of two levels, as +1 or -1 times half their distance; else 0
};

template <int N>
void normalise(std::vector<History<N>>& histories, double& log_likelihood) {
  double most = -1e300;
  for (const auto& h : histories) most = std::max(most, h.log_weight);
  double total = 0.0;
  for (const auto& h : histories) total += std::exp(h.log_weight - most);
  const double by = most + std::log(total);
  for (auto& h : histories) h.log_weight -= by;
  log_likelihood += by;
}

/// The likeliest history of those on `level`; nullptr where there is none.
template <int N>
const History<N>* likeliest(const std::vector<History<N>>& histories, double level) {
  const History<N>* best = nullptr;
  for (const auto& h : histories)
    if (h.level == level && (best == nullptr || h.log_weight > best->log_weight)) best = &h;
  return best;
}

template <int N>
double log_share(const std::vector<History<N>>& histories, double level) {
  double share = 0.0;
  for (const auto& h : histories)
    if (h.level == level) share += std::exp(h.log_weight);
  return std::log(std::max(share, 1e-300));
}

template <int N>
double jump_log_likelihood(const SlowLaw& law, std::span<const std::size_t> points,
                           const Eigen::VectorXd& values) {
  const Jumps& jumps = *law.jumps;
  SlowLaw still = law;
  still.jumps.reset();
  const bool two = jumps.to == Jumps::To::the_other_level;
  const Recursion<N> fresh(still);
  // A change between two levels leaves what is known of them as it is: one recursion for all.
  Recursion<N> common = fresh;
  const auto of = [&](History<N>& h) -> Recursion<N>& { return two ? common : h.recursion; };
  std::vector<History<N>> histories;
  for (const double side : two ? std::vector<double>{-1.0, 1.0} : std::vector<double>{0.0})
    histories.push_back({two ? std::log(0.5) : 0.0, fresh, {}, side * jumps.size_dps});
  double total = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0) {
      const std::size_t steps = points[k] - points[k - 1];
      const double mean = jumps.per_s * law.interval_s * static_cast<double>(steps);
      const double jump = two ? 0.5 * -std::expm1(-2.0 * mean) : -std::expm1(-mean);
      if (two) common.predict(steps);
      for (auto& h : histories) {
        if (!two) h.recursion.predict(steps);
        h.estimate.predict(of(h), steps);
      }
      std::vector<History<N>> born;
      for (const double side : two ? std::vector<double>{-1.0, 1.0} : std::vector<double>{0.0}) {
        const double from = side * jumps.size_dps;
        if (const History<N>* parent = likeliest(histories, from)) {
          History<N> child = *parent;
          child.log_weight = log_share(histories, from) + std::log(jump);
          child.level = -from;
          if (!two) child.recursion.widen_level(jumps.size_dps * jumps.size_dps);
          born.push_back(child);
        }
      }
      for (auto& h : histories) h.log_weight += std::log1p(-jump);
      histories.insert(histories.end(), born.begin(), born.end());
    }
    const double value = values[static_cast<Eigen::Index>(k)];
    if (two) common.update();
    for (auto& h : histories) {
      if (!two) h.recursion.update();
      const auto& recursion = of(h);
      const double innovation = value - h.level - h.estimate.expected(recursion.states());
      h.estimate.update(recursion, innovation);
      if (k > 0)
        h.log_weight -= 0.5 * (log_two_pi + recursion.log_variance() +
                               innovation * innovation / recursion.variance());
    }
    normalise(histories, total);
    while (histories.size() > most_histories) {
      const auto least = std::min_element(
          histories.begin(), histories.end(),
          [](const auto& a, const auto& b) { return a.log_weight < b.log_weight; });
      if (&*least != &histories.back()) *least = histories.back();
      histories.pop_back();
    }
  }
  return total;
}

/// Calls with the least number of states (std::integral_constant) that the law's recursion needs.
template <class Call>
auto with_room_for(const SlowLaw& law, Call&& call) {
  if (law.parts.size() < few_states) return call(std::integral_constant<int, few_states>{});
  if (law.parts.size() < some_states) return call(std::integral_constant<int, some_states>{});
  return call(std::integral_constant<int, most_states>{});
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
