#include <gyrostat/analysis/fits/arima_moments.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/analysis/spectra/arima_haar.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat {
namespace {

constexpr double most_missing = 0.05;
constexpr double tie_break = 0.1;
constexpr double significance = 0.999;

/// atanh phi, log delta1, atanh theta, log sqrt(R).
using FreeMoments = Vector<double, 4>;

template <class T>
Arima111<T> model_of(const T* free) {
  using std::exp;
  using std::tanh;
  const T delta1 = exp(free[1]);
  return {T(1.0 - 1e-9) * tanh(free[0]), delta1, tanh(free[2]) * delta1, exp(free[3])};
}

Arima111<double> model_of(const FreeMoments& free) { return model_of(free.data()); }

/// Allan variances at clusters 1, 2, 4, ... and the weights of their logarithms.
struct Moments {
  std::size_t samples;
  Eigen::VectorXd log_variance;
  Eigen::VectorXd log_bias;  ///< of the logarithm of a chi-square variable
  Eigen::MatrixXd whitener;  ///< W with W^T W the inverse covariance

  Eigen::Index scales() const { return log_variance.size(); }

  void weigh(const FreeMoments& free) {
    Eigen::MatrixXd covariance = log_allan_covariance(model_of(free), samples, scales());
    covariance.diagonal() *= 1.0 + 1e-6;  // a smooth x correlates the scales almost fully
    log_bias = -0.5 * covariance.diagonal();
    whitener = whitener_of(covariance);
  }

  template <class T>
  Vector<T, Eigen::Dynamic> misfit(const Arima111<T>& model) const {
    using std::log;
    Vector<T, Eigen::Dynamic> e = dyadic_allan_variances(model, scales());
    for (Eigen::Index j = 0; j < scales(); ++j) e[j] = log_variance[j] - log_bias[j] - log(e[j]);
    return whitener.template cast<T>() * e;
  }

  double chi_square(const FreeMoments& free) const { return misfit(model_of(free)).squaredNorm(); }
};

bool is_sound(double value) { return std::isfinite(value); }

template <int N>
bool is_sound(const ceres::Jet<double, N>& value) {
  return std::isfinite(value.a) && value.v.allFinite();
}

struct MomentResiduals {
  const Moments& moments;

  /// False at a step too far out for the model to be computed there: Ceres then tries a shorter
  /// one. Given numbers that are none it would do so as well, and print them.
  template <class T>
  bool operator()(const T* free, T* residuals) const {
    const auto misfit = moments.misfit(model_of(free));
    residuals = std::copy(misfit.begin(), misfit.end(), residuals);
    for (int i = 0; i < 4; ++i) residuals[i] = T(tie_break) * free[i];
    return std::all_of(misfit.begin(), misfit.end(), [](const T& m) { return is_sound(m); });
  }
};

enum class Family { RandomWalk, Full };

ceres::Solver::Summary solve(const Moments& moments, Family family, FreeMoments& free) {
  ceres::Problem problem;
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<MomentResiduals, ceres::DYNAMIC, 4>(
          new MomentResiduals{moments}, static_cast<int>(moments.scales()) + 4),
      nullptr, free.data());
  if (family == Family::RandomWalk)
    problem.SetManifold(free.data(), new ceres::SubsetManifold(4, {0, 2}));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

/// For phi and theta on a grid the delta1^2 and R, of which the variances are linear, by least
/// squares in their ratio to the observed; the four most promising.
std::vector<FreeMoments> starting_points(const Moments& moments) {
  std::vector<FreeMoments> starts;
  for (const double phi : {-0.7, 0.0, 0.7, 0.95, 0.995})
    for (const double theta : {-0.7, 0.0, 0.5, 0.9, 0.99}) {
      Eigen::MatrixX2d share(moments.scales(), 2);
      share << dyadic_allan_variances(Arima111<double>{phi, 1.0, theta, 0.0}, moments.scales()),
          dyadic_allan_variances(Arima111<double>{0.0, 0.0, 0.0, 1.0}, moments.scales());
      const Eigen::VectorXd weight =
          moments.whitener.diagonal().array() / moments.log_variance.array().exp();
      share = weight.asDiagonal() * share;
      const Vector<double, 2> square =
          (share.transpose() * share).ldlt().solve(share.transpose() * moments.whitener.diagonal());
      starts.emplace_back(std::atanh(phi), 0.5 * std::log(std::max(square[0], 1e-10)),
                          std::atanh(theta), 0.5 * std::log(std::max(square[1], 1e-4)));
    }
  std::partial_sort(starts.begin(), starts.begin() + 4, starts.end(),
                    [&](const FreeMoments& a, const FreeMoments& b) {
                      return moments.chi_square(a) < moments.chi_square(b);
                    });
  starts.resize(4);
  return starts;
}

/// Mean square deviation of phi, delta1, delta2, sqrt(R) from `mode` under the quasi-posterior
/// exp(-chi-square / (2 temperature)), all admissible parameters alike beforehand: a Metropolis
/// walk in the free parameters, whose steps take the covariance of the round before.
Matrix<double, 4> spread_about(const FreeMoments& mode, const Moments& moments,
                               double temperature) {
  constexpr int rounds = 5, steps = 3000;
  const NormalStream kicks(0, 0, "quasi-posterior"), coins(0, 0, "quasi-posterior acceptance");
  const auto log_density = [&](const FreeMoments& free) {
    const auto model = model_of(free);
    const double volume = model.delta1_dps * model.measurement_noise_std_dps /
                          std::pow(std::cosh(free[0]) * std::cosh(free[2]), 2);
    return std::log(volume) - 0.5 * moments.chi_square(free) / temperature;
  };
  const auto natural = [](const FreeMoments& free) {
    const auto model = model_of(free);
    return FreeMoments(model.phi, model.delta1_dps, model.delta2_dps,
                       model.measurement_noise_std_dps);
  };
  FreeMoments at = mode;
  double log_at = log_density(at);
  Matrix<double, 4> step = 0.01 * Matrix<double, 4>::Identity();
  Matrix<double, 4> spread;
  std::uint64_t draw = 0;
  for (int round = 0; round < rounds; ++round) {
    Matrix<double, 4> square = 1e-8 * steps * Matrix<double, 4>::Identity();
    FreeMoments sum = FreeMoments::Zero();
    spread.setZero();
    for (int k = 0; k < steps; ++k, ++draw) {
      FreeMoments kick;
      kicks.fill(4 * draw, {kick.data(), 4});
      const FreeMoments next = at + step * kick;
      const double log_next = log_density(next);
      if (std::log(coins.uniform(draw)) < log_next - log_at) {
        at = next;
        log_at = log_next;
      }
      sum += at - mode;
      square += (at - mode) * (at - mode).transpose();
      const FreeMoments deviation = natural(at) - natural(mode);
      spread += deviation * deviation.transpose() / steps;
    }
    const Matrix<double, 4> covariance = (square - sum * sum.transpose() / steps) / steps;
    step = 2.38 / 2.0 * covariance.llt().matrixL().toDenseMatrix();  // Gelman et al. 1996
  }
  return spread;
}

Moments measure(std::span<const double> rate, double& unit) {
  const std::size_t n = rate.size();
  const auto missing =
      std::count_if(rate.begin(), rate.end(), [](double y) { return !std::isfinite(y); });
  if (n < fewest_for_moments)
    throw InputError("rate", std::to_string(n) + " samples; at least " +
                                 std::to_string(fewest_for_moments) + " are needed");
  if (static_cast<double>(missing) > most_missing * static_cast<double>(n))
    throw InputError("rate", std::to_string(missing) + " of " + std::to_string(n) +
                                 " samples are missing; at most 5 % may be");
  std::vector<std::size_t> clusters;
  for (std::size_t m = 1; m <= n / 16; m *= 2) clusters.push_back(m);
  const auto variances = robust_allan_variances(without_spikes(rate), clusters);
  unit = std::sqrt(variances.front());
  if (!(unit > 0.0)) throw InputError("rate", "hardly ever changes");
  Moments moments{.samples = n, .log_variance = {}, .log_bias = {}, .whitener = {}};
  moments.log_variance =
      (Eigen::VectorXd::Map(variances.data(), std::ssize(variances)) / variances.front())
          .array()
          .log();
  return moments;
}

ArimaFit fitted(std::span<const double> rate_dps, Family largest) {
  double unit = 1.0;
  Moments moments = measure(rate_dps, unit);
  ArimaFit fit;
  fit.samples = rate_dps.size();
  const auto run = [&](Family family, FreeMoments& free) {
    const auto summary = solve(moments, family, free);
    fit.iterations += static_cast<int>(summary.iterations.size());
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
    fit.message = fit.converged ? "converged" : summary.message;
    return moments.chi_square(free);
  };

  FreeMoments walk(0.0, -3.0, 0.0, 0.0);
  moments.weigh(walk);
  run(Family::RandomWalk, walk);
  moments.weigh(walk);
  const double walk_misfit = run(Family::RandomWalk, walk);
  FreeMoments best = walk;
  const bool may_be_full = largest == Family::Full;
  double misfit = may_be_full ? run(Family::Full, best) : walk_misfit;
  for (FreeMoments& start : may_be_full ? starting_points(moments) : std::vector<FreeMoments>())
    if (const double other = run(Family::Full, start); other < misfit) {
      misfit = other;
      best = start;
    }

  const auto quantile_of = [](double degrees) {
    return chi_squared_quantile(significance, degrees);
  };
  const bool is_walk = walk_misfit - misfit < quantile_of(2.0);
  if (is_walk) best = walk;
  for (int round = 0; round < 2; ++round) {
    moments.weigh(best);
    fit.objective = run(is_walk ? Family::RandomWalk : Family::Full, best);
  }
  if (is_walk) fit.message += "; x is no more than a random walk: phi and delta2 cannot be told";
  const auto degrees = static_cast<double>(moments.scales() - (is_walk ? 2 : 4));
  const bool refuted = fit.objective > quantile_of(degrees);
  if (refuted) fit.message += "; the model does not describe these data";

  const FreeMoments units(1.0, unit, unit, unit);
  Eigen::Map<Eigen::Matrix4d> fitted(fit.covariance[0].data());
  fitted = units.asDiagonal() *
           spread_about(best, moments, refuted ? fit.objective / degrees : 1.0) *
           units.asDiagonal();
  const FreeMoments errors = fitted.diagonal().cwiseSqrt();
  fit.standard_errors = {errors[0], errors[1], errors[2], errors[3]};
  const auto model = model_of(best);
  fit.parameters = {model.phi, model.delta1_dps * unit, model.delta2_dps * unit,
                    model.measurement_noise_std_dps * unit};
  return fit;
}

}  // namespace

ArimaFit fit_arima_moments(std::span<const double> rate_dps) {
  return fitted(rate_dps, Family::Full);
}

ArimaFit fit_walk_moments(std::span<const double> rate_dps) {
  return fitted(rate_dps, Family::RandomWalk);
}

}  // namespace gyrostat
