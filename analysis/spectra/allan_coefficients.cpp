#include <gyrostat/analysis/spectra/allan_coefficients.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <boost/math/tools/roots.hpp>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {
namespace {

constexpr int terms = 5;
constexpr unsigned all_terms = (1U << terms) - 1;
// Quantiles of chi-square on one degree of freedom.
constexpr double cost_of_a_term = 6.6348966010212145;   // 99 %
constexpr double two_sided = 3.8414588206941254;        // 95 %
constexpr double one_sided = 2.7055434540954148;        // 90 %: 5 % on the one side
constexpr double cost_of_a_point = 10.827566170662733;  // 99.9 %
constexpr double adequacy = 0.99;
constexpr double octave = 1.9;

/// Q^2, N^2, B^2, K^2, R^2.
using Squares = Vector<double, terms>;

Squares shape(double tau) {
  return {3.0 / (tau * tau), 1.0 / tau, 2.0 * std::numbers::ln2 / std::numbers::pi, tau / 3.0,
          0.5 * tau * tau};
}

struct Solution {
  Squares squares = Squares::Zero();
  double chi_square = 0.0;
};

unsigned support(const Squares& squares) {
  unsigned mask = 0;
  for (int k = 0; k < terms; ++k)
    if (squares[k] > 0.0) mask |= 1U << k;
  return mask;
}

/// argmin |A x - b| over x >= 0 with x_k = 0 for k outside `allowed`: of all subsets, from `guess`
/// on, the one whose unconstrained solution is feasible and that no other term improves.
Squares non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                   unsigned allowed, unsigned guess) {
  const Squares scale = a.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = a * scale.asDiagonal();
  const Matrix<double, terms> normal = scaled.transpose() * scaled;
  const Squares right = scaled.transpose() * b;
  Squares best = Squares::Zero();
  double most = 0.0;
  for (unsigned flips = 0; flips <= all_terms; ++flips) {
    const unsigned subset = (guess & allowed) ^ flips;
    if ((subset & ~allowed) != 0) continue;
    Matrix<double, terms> part = Matrix<double, terms>::Identity();
    Squares side = Squares::Zero();
    for (int i = 0; i < terms; ++i) {
      if ((subset >> i & 1U) == 0) continue;
      side[i] = right[i];
      for (int j = 0; j < terms; ++j)
        if ((subset >> j & 1U) != 0) part(i, j) = normal(i, j);
    }
    const Squares x = part.llt().solve(side);
    const double gain = x.dot(side);
    if (!(x.minCoeff() >= 0.0 && gain > most)) continue;
    most = gain;
    best = scale.cwiseProduct(x);
    const Squares slope = right - normal * x;
    double steepest = 0.0;
    for (int k = 0; k < terms; ++k)
      if ((allowed & ~subset) >> k & 1U) steepest = std::max(steepest, slope[k]);
    if (steepest <= 1e-12 * b.norm()) break;
  }
  return best;
}

class Fit {
 public:
  explicit Fit(std::vector<AllanPoint> points)
      : points_(std::move(points)),
        shapes_(std::ssize(points_), terms),
        log_variance_(std::ssize(points_)),
        target_(std::ssize(points_)) {
    for (Eigen::Index j = 0; j < size(); ++j) {
      shapes_.row(j) = shape(points_[j].tau_s);
      log_variance_[j] = 2.0 * std::log(points_[j].deviation);
    }
    tabulate_gains();
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(size());
    for (unsigned allowed = 1; allowed <= all_terms; ++allowed)
      solutions_.push_back({start(allowed, nothing), 0.0});
    best_ = solutions_.back();
    for (int round = 0; round < 3; ++round) {
      weigh(best_.squares);
      for (unsigned allowed = 1; allowed <= all_terms; ++allowed)
        solutions_[allowed - 1] = descend(solutions_[allowed - 1].squares, allowed, nothing);
      best_ = *std::min_element(
          solutions_.begin(), solutions_.end(),
          [](const auto& a, const auto& b) { return a.chi_square < b.chi_square; });
    }
  }

  /// Multiplies all variances.
  void widen(double factor) {
    whitener_ /= std::sqrt(factor);
    for (auto& solution : solutions_) solution.chi_square /= factor;
  }

  Eigen::Index size() const { return std::ssize(points_); }
  double shortest_tau() const { return points_.front().tau_s; }

  /// Least chi-square for each set of terms. Some are local minima of a larger set, so the least
  /// over all five terms is the least of these.
  const std::vector<Solution>& solutions() const { return solutions_; }
  const Solution& best() const { return best_; }

  /// Least chi-square with term k at `square`, sought from the linear fit and from `near`.
  double profile(int k, double square, Squares near) const {
    const unsigned others = all_terms & ~(1U << k);
    const Eigen::VectorXd given = square * shapes_.col(k);
    near[k] = 0.0;
    return std::min(descend(start(others, given), others, given).chi_square,
                    descend(near, others, given).chi_square);
  }

  /// The square of term k that alone would reach the fit at one point.
  double reach(int k, const Squares& squares) const {
    return (shapes_ * squares).cwiseQuotient(shapes_.col(k)).minCoeff();
  }

  /// Standard errors of the squares that are not 0, the others held at 0.
  Squares standard_errors(const Squares& squares) const {
    const Eigen::VectorXd inverse = (shapes_ * squares).cwiseInverse();
    const Eigen::MatrixXd relative =
        whitener_ * inverse.asDiagonal() * shapes_ * squares.asDiagonal();
    Matrix<double, terms> information = relative.transpose() * relative;
    for (int k = 0; k < terms; ++k)
      if (squares[k] == 0.0) information(k, k) = 1.0;
    return information.inverse().diagonal().cwiseSqrt().cwiseProduct(squares);
  }

 private:
  /// Gauss-Newton steps in the logarithm, halved until they improve.
  Solution descend(const Squares& from, unsigned allowed, const Eigen::VectorXd& given) const {
    Solution at{from, chi_square(from, given)};
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Eigen::VectorXd variance = given + shapes_ * at.squares;
      const Eigen::MatrixXd slope = variance.cwiseInverse().asDiagonal() * shapes_;
      const Eigen::VectorXd misfit = target_ - variance.array().log().matrix();
      const Squares next =
          non_negative_least_squares(whitener_ * slope, whitener_ * (misfit + slope * at.squares),
                                     allowed, support(at.squares));
      double step = 1.0, improved = chi_square(next, given);
      while (!(improved <= at.chi_square) && step > 1e-6) {
        step *= 0.5;
        improved = chi_square(at.squares + step * (next - at.squares), given);
      }
      const double gain = at.chi_square - improved;
      if (!(gain >= 0.0)) break;
      at = {at.squares + step * (next - at.squares), improved};
      if (gain <= 1e-9 * (1.0 + improved)) break;
    }
    return at;
  }

  /// Linear least squares in the ratio to the observed variances, each by its own weight only.
  Squares start(unsigned allowed, const Eigen::VectorXd& given) const {
    const Eigen::VectorXd inverse = (-log_variance_).array().exp();
    Eigen::VectorXd weight(size());
    for (Eigen::Index j = 0; j < size(); ++j) weight[j] = std::sqrt(points_[j].power_law_edf);
    const Eigen::VectorXd rest = 1.0 - given.array() * inverse.array();
    return non_negative_least_squares(weight.cwiseProduct(inverse).asDiagonal() * shapes_,
                                      weight.cwiseProduct(rest), allowed, allowed);
  }

  double chi_square(const Squares& squares, const Eigen::VectorXd& given) const {
    const Eigen::VectorXd variance = given + shapes_ * squares;
    return (whitener_ * (target_ - variance.array().log().matrix())).squaredNorm();
  }

  /// Power gains of the points' windows at frequencies f, cycles a sample, evenly spread in log f:
  /// sin^4(pi f m) / (m sin(pi f))^2. Steps of the golden ratio keep f m from aliasing.
  void tabulate_gains() {
    constexpr double per_octave = 200.0;
    const double octaves = std::log2(256.0 * static_cast<double>(points_.back().cluster));
    const auto count = static_cast<Eigen::Index>(per_octave * octaves);
    gains_.resize(count, size());
    frequency_.resize(count);
    double place = 0.5;
    for (Eigen::Index i = 0; i < count; ++i) {
      place += std::numbers::phi - 1.0;
      place -= std::floor(place);
      const double f = 0.5 * std::exp2(-octaves * place);
      frequency_[i] = f;
      for (Eigen::Index j = 0; j < size(); ++j) {
        const auto m = static_cast<double>(points_[j].cluster);
        const double sine = std::sin(std::numbers::pi * f * m);
        const double ratio = sine * sine / (m * std::sin(std::numbers::pi * f));
        gains_(i, j) = ratio * ratio;
      }
    }
    frequency_measure_ = 2.0 * std::numbers::ln2 * octaves / static_cast<double>(count);
  }

  /// Means, variances and correlations of the log variances, for the spectrum of `squares`. A point
  /// knows its degrees of freedom if quantisation noise were white noise of the same variance.
  void weigh(const Squares& squares) {
    const double interval = points_.front().tau_s / static_cast<double>(points_.front().cluster);
    const Eigen::ArrayXd w = 2.0 / interval * (std::numbers::pi * frequency_.array()).sin();
    Eigen::ArrayXd rest = squares[1] + squares[2] / w + squares[3] / w.square();
    const Eigen::ArrayXd quantisation = squares[0] * interval * w.square();
    if (!(rest.maxCoeff() + quantisation.maxCoeff() > 0.0)) rest.setOnes();

    const Eigen::VectorXd measure = frequency_measure_ * frequency_;
    const Eigen::MatrixXd power = (rest + quantisation).matrix().asDiagonal() * gains_;
    const Eigen::MatrixXd product = power.transpose() * measure.asDiagonal() * power;
    Eigen::VectorXd scale(size());
    for (Eigen::Index j = 0; j < size(); ++j) {
      const Eigen::ArrayXd as_white =
          gains_.col(j).array() * (rest + 3.0 * squares[0] / points_[j].tau_s);
      const double edf =
          points_[j].power_law_edf * measure.dot(as_white.square().matrix()) / product(j, j);
      target_[j] = log_variance_[j] - digamma(0.5 * edf) + std::log(0.5 * edf);
      scale[j] = std::sqrt(trigamma(0.5 * edf) / product(j, j));
    }
    const Eigen::MatrixXd covariance = scale.asDiagonal() * product * scale.asDiagonal();
    whitener_ = whitener_of(covariance);
  }

  std::vector<AllanPoint> points_;
  std::vector<Solution> solutions_;
  Solution best_;
  Eigen::Matrix<double, Eigen::Dynamic, terms> shapes_;
  Eigen::VectorXd log_variance_, target_;
  Eigen::MatrixXd whitener_, gains_;
  Eigen::VectorXd frequency_;
  double frequency_measure_ = 0.0;
};

int count_terms(const Solution& solution) { return std::popcount(support(solution.squares)); }

int degrees_of_freedom(const Fit& fit) {
  return static_cast<int>(fit.size()) - count_terms(fit.best());
}

bool adequate(const Fit& fit) {
  const int degrees = degrees_of_freedom(fit);
  return degrees < 1 || fit.best().chi_square <= chi_squared_quantile(adequacy, degrees);
}

Solution most_plausible(const Fit& fit) {
  const auto cost = [](const Solution& s) {
    return s.chi_square + cost_of_a_term * count_terms(s);
  };
  return *std::min_element(fit.solutions().begin(), fit.solutions().end(),
                           [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
}

/// Where the profile of term k passes `level` between the solution and `outside`.
double crossing(const Fit& fit, int k, double level, const Solution& solution, double outside) {
  const auto excess = [&](double square) {
    return fit.profile(k, square, solution.squares) - level;
  };
  const double inside = solution.squares[k];
  const double at_inside = excess(inside);
  const double at_outside = excess(outside);
  if (!(at_outside > 0.0)) return outside;
  std::uintmax_t evaluations = 60;
  const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-4 * std::max(a, b); };
  const auto solve = [&](double a, double b, double at_a, double at_b) {
    return boost::math::tools::toms748_solve(excess, a, b, at_a, at_b, close, evaluations);
  };
  const auto [a, b] = inside < outside ? solve(inside, outside, at_inside, at_outside)
                                       : solve(outside, inside, at_outside, at_inside);
  return 0.5 * (a + b);
}

std::vector<AllanPoint> an_octave_apart(std::span<const AllanPoint> points) {
  std::vector<AllanPoint> kept;
  double last = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    const auto place = "points[" + std::to_string(i) + "]";
    for (const double x : {p.tau_s, p.deviation, p.power_law_edf, static_cast<double>(p.cluster)})
      if (!(x > 0.0 && std::isfinite(x)))
        throw InputError(place, "tau, deviation, edf and cluster are not all positive and finite");
    if (!(p.tau_s > last)) throw InputError(place, "tau does not rise");
    last = p.tau_s;
    if (kept.empty() || p.tau_s >= octave * kept.back().tau_s) kept.push_back(p);
  }
  if (kept.size() < terms)
    throw InputError("points", std::to_string(kept.size()) + " are an octave apart; at least " +
                                   std::to_string(terms) + " are needed");
  return kept;
}

}  // namespace

double allan_deviation(const AllanCoefficients& c, double tau_s) {
  const Squares values(c.quantisation_deg.value, c.angle_random_walk_dps_per_sqrt_hz.value,
                       c.bias_instability_dps.value, c.rate_random_walk_dps_sqrt_hz.value,
                       c.rate_ramp_dps_per_s.value);
  return std::sqrt(shape(tau_s).dot(values.cwiseAbs2()));
}

std::vector<std::size_t> octave_clusters(std::size_t samples) {
  std::vector<std::size_t> clusters;
  for (std::size_t m = 1; m <= samples / 8; m *= 2) clusters.push_back(m);
  return clusters;
}

AllanCoefficients fit_allan_coefficients(std::span<const AllanPoint> points) {
  const auto used = an_octave_apart(points);
  Fit fit(used);
  const bool whole = adequate(fit);
  const double misfit = fit.best().chi_square;
  const std::size_t fewest = std::max<std::size_t>(terms, (used.size() + 1) / 2);
  for (std::size_t left_out = 1; !whole && left_out + fewest <= used.size(); ++left_out) {
    Fit rest({used.begin() + static_cast<std::ptrdiff_t>(left_out), used.end()});
    const double gain = misfit - rest.best().chi_square;
    if (!adequate(rest) || gain < cost_of_a_point * static_cast<double>(left_out)) continue;
    fit = std::move(rest);
    break;
  }
  AllanCoefficients out;
  out.shortest_tau_s = fit.shortest_tau();
  out.chi_square = fit.best().chi_square;
  out.degrees_of_freedom = degrees_of_freedom(fit);
  out.adequate = adequate(fit);
  if (!out.adequate) fit.widen(out.chi_square / out.degrees_of_freedom);
  const auto shown = most_plausible(fit);
  const Squares errors = fit.standard_errors(shown.squares);

  const std::array<AllanCoefficient*, terms> coefficients = {
      &out.quantisation_deg, &out.angle_random_walk_dps_per_sqrt_hz, &out.bias_instability_dps,
      &out.rate_random_walk_dps_sqrt_hz, &out.rate_ramp_dps_per_s};
  for (int k = 0; k < terms; ++k) {
    const double square = shown.squares[k];
    const double level = shown.chi_square + (square > 0.0 ? two_sided : one_sided);
    double outside = std::max(square, fit.reach(k, shown.squares));
    for (int i = 0; i < 500 && fit.profile(k, outside, shown.squares) < level; ++i) outside *= 2.0;
    auto& c = *coefficients[k];
    c.upper = std::sqrt(crossing(fit, k, level, shown, outside));
    if (!(square > 0.0)) continue;
    c.value = std::sqrt(square);
    c.standard_error = errors[k] / (2.0 * c.value);
    c.lower = std::sqrt(crossing(fit, k, level, shown, 0.0));
  }
  return out;
}

AllanCoefficients fit_allan_coefficients(std::span<const double> rate_dps, double rate_hz) {
  const auto clusters = octave_clusters(rate_dps.size());
  if (clusters.empty())
    throw InputError("rate", std::to_string(rate_dps.size()) + " samples; at least 128 are needed");
  return fit_allan_coefficients(overlapping_allan_deviation(rate_dps, rate_hz, clusters));
}

}  // namespace gyrostat
