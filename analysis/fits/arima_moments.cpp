#include "analysis/fits/arima_moments.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <ceres/ceres.h>

#include "analysis/spectra/allan.hpp"
#include "analysis/spectra/arima_haar.hpp"
#include "core/error.hpp"
#include "core/random.hpp"

namespace gyrostat {
namespace {

constexpr std::size_t fewest_samples = 512;
constexpr double huber_excess = 0.0092;
constexpr double tie_break = 0.1;

/// atanh phi, log delta1, atanh theta, log sqrt(R).
using Free = std::array<double, 4>;

template <class T>
Arima111<T> model_of(const T* free) {
  using std::exp;
  using std::tanh;
  const T delta1 = exp(free[1]);
  return {T(1.0 - 1e-9) * tanh(free[0]), delta1, tanh(free[2]) * delta1, exp(free[3])};
}

/// Allan variances at clusters 1, 2, 4, ... and the weights of their logarithms.
struct Moments {
  Eigen::VectorXd log_variance;
  Eigen::MatrixXd whitener;  ///< W^T W is the inverse covariance
  Eigen::VectorXd log_bias;  ///< of the logarithm of a chi-square variable

  void weigh(Eigen::MatrixXd covariance) {
    const auto n = covariance.rows();
    covariance += huber_excess * covariance.cwiseAbs2().cwiseQuotient((covariance.diagonal() * covariance.diagonal().transpose()).cwiseSqrt());
    whitener = covariance.llt().matrixL().solve(Eigen::MatrixXd::Identity(n, n));
    log_bias = -0.5 * covariance.diagonal();
  }

  template <class T>
  Eigen::Matrix<T, Eigen::Dynamic, 1> misfit(const Arima111<T>& model) const {
    using std::log;
    Eigen::Matrix<T, Eigen::Dynamic, 1> e(log_variance.size());
    for (Eigen::Index j = 0; j < e.size(); ++j)
      e[j] =
          T(log_variance[j] - log_bias[j]) - log(arima_allan_variance(model, std::size_t{1} << j));
    return whitener.template cast<T>() * e;
  }
};

struct MisfitResidual {
  const Moments& moments;

  template <class T>
  bool operator()(const T* free, T* residuals) const {
    const auto misfit = moments.misfit(model_of(free));
    std::copy(misfit.begin(), misfit.end(), residuals);
    for (int i = 0; i < 4; ++i) residuals[misfit.size() + i] = T(tie_break) * free[i];
    return true;
  }
};

enum class Family { RandomWalk, Full };

ceres::Solver::Summary solve(const Moments& moments, Family family, Free& free) {
  ceres::Problem problem;
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<MisfitResidual, ceres::DYNAMIC, 4>(
          new MisfitResidual{moments}, static_cast<int>(moments.log_variance.size()) + 4),
      nullptr, free.data());
  if (family == Family::RandomWalk)
    problem.SetManifold(free.data(), new ceres::SubsetManifold(4, {0, 2}));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-8;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

/// For each phi and theta of a grid the delta1 and R that fit best, of which the variances are
/// linear; the most promising first.
std::vector<Free> starting_points(const Moments& moments) {
  std::vector<std::pair<double, Free>> starts;
  for (const double phi : {-0.7, 0.0, 0.7, 0.95, 0.995})
    for (const double theta : {-0.7, 0.0, 0.5, 0.9, 0.99}) {
      Eigen::MatrixX2d share(moments.log_variance.size(), 2);
      for (Eigen::Index j = 0; j < share.rows(); ++j) {
        const auto m = std::size_t{1} << j;
        share(j, 0) = arima_allan_variance(Arima111<double>{phi, 1.0, theta, 0.0}, m);
        share(j, 1) = 1.0 / static_cast<double>(m);
      }
      const Eigen::VectorXd weight =
          moments.whitener.diagonal().array() * (-moments.log_variance).array().exp();
      const Eigen::MatrixX2d a = weight.asDiagonal() * share;
      const Eigen::Vector2d best =
          (a.transpose() * a).ldlt().solve(a.transpose() * moments.whitener.diagonal());
      const Free free = {std::atanh(phi), 0.5 * std::log(std::max(best[0], 1e-10)),
                         std::atanh(theta), 0.5 * std::log(std::max(best[1], 1e-4))};
      starts.emplace_back(moments.misfit(model_of(free.data())).squaredNorm(), free);
    }
  std::sort(starts.begin(), starts.end());
  std::vector<Free> ordered;
  for (const auto& [cost, free] : starts) ordered.push_back(free);
  return ordered;
}

/// Mean square deviation of phi, delta1, delta2, sqrt(R) from `mode` under the quasi-posterior
/// exp(-misfit / (2 temperature)) with all admissible parameters equally likely (Chernozhukov &
/// Hong, J. Econometrics 2003), by a Metropolis walk over the free parameters.
Matrix<double, 4> spread_about(const Free& mode, const Moments& moments, double temperature) {
  using Point = Vector<double, 4>;
  constexpr int rounds = 5, steps = 3000;
  const NormalStream normals(0, 0, "quasi-posterior"), uniforms(0, 0, "quasi-posterior accept");
  const auto log_density = [&](const Point& u) {
    const auto model = model_of(u.data());
    const double volume =
        std::log((1.0 - model.phi * model.phi) * model.delta1_dps *
                 (1.0 - std::pow(std::tanh(u[2]), 2)) * model.measurement_noise_std_dps);
    return volume - 0.5 * moments.misfit(model).squaredNorm() / temperature;
  };
  const auto natural = [](const Point& u) {
    const auto model = model_of(u.data());
    return Point(model.phi, model.delta1_dps, model.delta2_dps, model.measurement_noise_std_dps);
  };
  Point at(mode.data());
  double log_here = log_density(at);
  Matrix<double, 4> step = 0.01 * Matrix<double, 4>::Identity();
  Matrix<double, 4> spread;
  std::uint64_t draw = 0;
  for (int round = 0; round < rounds; ++round) {
    Point sum = Point::Zero();
    Matrix<double, 4> square = Matrix<double, 4>::Zero();
    spread.setZero();
    for (int k = 0; k < steps; ++k, ++draw) {
      Point kick;
      normals.fill(4 * draw, {kick.data(), 4});
      const Point next = at + step * kick;
      const double log_next = log_density(next);
      if (std::log(uniforms.uniform(draw)) < log_next - log_here) at = next, log_here = log_next;
      sum += at;
      square += at * at.transpose();
      const Point deviation = natural(at) - natural(Point(mode.data()));
      spread += deviation * deviation.transpose() / steps;
    }
    const Matrix<double, 4> covariance = square / steps - sum * sum.transpose() / (steps * steps);
    step = 1.19 *
           Matrix<double, 4>((covariance + 1e-8 * Matrix<double, 4>::Identity()).llt().matrixL());
  }
  return spread;
}

}  // namespace

ArimaFit fit_arima_moments(std::span<const double> rate_dps) {
  const std::size_t n = rate_dps.size();
  if (n < fewest_samples)
    throw InputError("rate", std::to_string(n) + " samples; at least " +
                                 std::to_string(fewest_samples) + " are needed");
  const std::size_t scales = std::bit_width(n / 16);
  std::vector<std::size_t> clusters;
  for (std::size_t j = 0; j < scales; ++j) clusters.push_back(std::size_t{1} << j);
  const auto variances = robust_allan_variances(without_spikes(rate_dps), clusters);
  const double unit = std::sqrt(variances.front());
  if (!(unit > 0.0)) throw InputError("rate", "hardly ever changes");

  Moments moments;
  moments.log_variance =
      Eigen::VectorXd::Map(variances.data(), variances.size()).array().log() - 2.0 * std::log(unit);
  moments.weigh(log_allan_covariance({0.0, 1e-9, 0.0, 1.0}, n, scales).diagonal().asDiagonal());

  ArimaFit fit;
  fit.samples = n;
  const auto run = [&](Family family, Free& free) {
    const auto summary = solve(moments, family, free);
    fit.iterations += static_cast<int>(summary.iterations.size());
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
    fit.message = summary.message;
    return moments.misfit(model_of(free.data())).squaredNorm();
  };
  const auto reweigh = [&](const Free& free) {
    moments.weigh(log_allan_covariance(model_of(free.data()), n, scales));
  };
  auto starts = starting_points(moments);
  starts.resize(4);
  Free walk = {0.0, -3.0, 0.0, 0.0};
  run(Family::RandomWalk, walk);
  reweigh(walk);
  const double walk_misfit = run(Family::RandomWalk, walk);
  double best_cost = std::numeric_limits<double>::infinity();
  Free best{};
  starts.push_back(walk);
  for (Free free : starts) {
    const double misfit = run(Family::Full, free);
    if (misfit < best_cost) best_cost = misfit, best = free;
  }
  const bool is_walk = walk_misfit - best_cost < quantile(boost::math::chi_squared(2), 0.999);
  if (is_walk) best = walk;
  for (int round = 0; round < 2; ++round) {
    reweigh(best);
    run(is_walk ? Family::RandomWalk : Family::Full, best);
  }
  const auto model = model_of(best.data());
  fit.objective = moments.misfit(model).squaredNorm();
  const double degrees = static_cast<double>(scales - (is_walk ? 2 : 4));
  const bool refuted = fit.objective > quantile(boost::math::chi_squared(degrees), 0.999);
  fit.covariance = spread_about(best, moments, refuted ? fit.objective / degrees : 1.0);
  if (refuted) fit.message += "; the model does not describe these data";
  if (is_walk) fit.message += "; phi and delta2 cannot be told from these data";
  fit.covariance.bottomRightCorner<3, 3>() *= unit * unit;
  fit.covariance.topRightCorner<1, 3>() *= unit;
  fit.covariance.bottomLeftCorner<3, 1>() *= unit;
  const Vector<double, 4> errors = fit.covariance.diagonal().cwiseSqrt();
  fit.standard_errors = {errors[0], errors[1], errors[2], errors[3]};
  fit.parameters = {model.phi, model.delta1_dps * unit, model.delta2_dps * unit,
                    model.measurement_noise_std_dps * unit};
  return fit;
}

}  // namespace gyrostat
