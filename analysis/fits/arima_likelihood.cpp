#include "analysis/fits/arima_likelihood.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "analysis/fits/arima_innovations.hpp"
#include "core/error.hpp"

namespace gyrostat {
namespace {

/// phi and theta are tanh of the first two, sqrt(R) / delta1 is exp of the third.
using Shape = std::array<double, 3>;

constexpr std::size_t fewest_samples = 50;
constexpr double shape_limit = 6.0;      // |phi|, |theta| < 1 - 1.2e-5
constexpr double log_ratio_limit = 12.0;

template <class T>
Arima111<T> unit_model(const T* shape) {
  using std::exp;
  using std::tanh;
  const T phi = tanh(shape[0]);
  const T theta = tanh(shape[1]);
  return {phi, T(1.0), theta, exp(shape[2])};
}

/// What concentrating out the scale leaves: sum nu^2 / s and sum log s over the terms.
struct Concentrated {
  double squares = 0.0;
  double logs = 0.0;
  double count = 0.0;

  double objective() const { return std::log(squares / count) + logs / count; }
};

Concentrated concentrate(const Shape& shape, std::span<const double> z) {
  Concentrated sums;
  arima_innovations(unit_model(shape.data()), z, [&](double nu, double s) {
    sums.squares += nu * nu / s;
    sums.logs += std::log(s);
    sums.count += 1.0;
  });
  return sums;
}

class PredictionErrors final : public ceres::CostFunction {
 public:
  PredictionErrors(std::span<const double> z, int terms) : z_(z) {
    set_num_residuals(terms);
    mutable_parameter_block_sizes()->push_back(3);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return jacobians && jacobians[0] ? evaluate<ceres::Jet<double, 3>>(parameters[0], residuals,
                                                                       jacobians[0])
                                     : evaluate<double>(parameters[0], residuals, nullptr);
  }

 private:
  template <class T>
  bool evaluate(const double* parameters, double* residuals, double* jacobian) const {
    using std::exp;
    using std::log;
    using std::sqrt;
    std::array<T, 3> shape;
    for (int i = 0; i < 3; ++i) {
      if constexpr (std::is_same_v<T, double>) shape[i] = parameters[i];
      else shape[i] = T(parameters[i], i);
    }
    std::vector<T> whitened;
    whitened.reserve(num_residuals());
    T logs(0.0);
    arima_innovations(unit_model(shape.data()), z_, [&](const T& nu, const T& s) {
      whitened.push_back(nu / sqrt(s));
      logs += log(s);
    });
    if (static_cast<int>(whitened.size()) != num_residuals()) return false;
    const T scale = exp(logs / T(2.0 * num_residuals()));
    for (std::size_t k = 0; k < whitened.size(); ++k) {
      const T r = whitened[k] * scale;
      if constexpr (std::is_same_v<T, double>) {
        residuals[k] = r;
      } else {
        residuals[k] = r.a;
        std::copy_n(r.v.data(), 3, jacobian + 3 * k);
      }
    }
    return std::isfinite(residuals[0]);
  }

  std::span<const double> z_;
};

struct Start {
  Shape shape;
  double objective;
};

/// The most promising points of a coarse grid, best first.
std::vector<Start> starting_points(std::span<const double> z) {
  std::vector<Start> starts;
  for (const double phi : {-0.6, 0.0, 0.6, 0.9})
    for (const double theta : {-0.6, 0.1, 0.7, 0.95})
      for (const double log_ratio : {-1.0, 1.0, 2.5, 4.5, 6.5}) {
        const Shape shape = {std::atanh(phi), std::atanh(theta), log_ratio};
        starts.push_back({shape, concentrate(shape, z).objective()});
      }
  std::sort(starts.begin(), starts.end(),
            [](const Start& a, const Start& b) { return a.objective < b.objective; });
  starts.resize(3);
  return starts;
}

/// Expected information of (phi, delta1, delta2, sqrt R) given the innovations
/// (Durbin and Koopman 2012, sec. 7.3.5): sum of d nu d nu^T / S + dS dS^T / (2 S^2).
Eigen::Matrix4d information(const Arima111<double>& arima, std::span<const double> z) {
  using Jet = ceres::Jet<double, 4>;
  const Arima111<Jet> jets{Jet(arima.phi, 0), Jet(arima.delta1_dps, 1), Jet(arima.delta2_dps, 2),
                           Jet(arima.measurement_noise_std_dps, 3)};
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  arima_innovations(jets, z, [&](const Jet& nu, const Jet& s) {
    sum += nu.v * nu.v.transpose() / s.a + s.v * s.v.transpose() / (2.0 * s.a * s.a);
  });
  return sum;
}

void add_standard_errors(ArimaFit& fit, std::span<const double> z) {
  // Scaled to a unit diagonal, so that definiteness does not depend on units.
  const Eigen::Matrix4d info = information(fit.parameters, z);
  const Eigen::Vector4d scale = info.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::LDLT<Eigen::Matrix4d> factor(scale.asDiagonal() * info * scale.asDiagonal());
  if (factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 1e-10) {
    const Eigen::Matrix4d inverse = factor.solve(Eigen::Matrix4d::Identity());
    fit.covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  } else {
    fit.covariance = Eigen::Vector4d::Constant(std::numeric_limits<double>::infinity()).asDiagonal();
    fit.message += "; the parameters are not all identifiable from this signal";
  }
  fit.standard_errors = {std::sqrt(fit.covariance(0, 0)), std::sqrt(fit.covariance(1, 1)),
                         std::sqrt(fit.covariance(2, 2)), std::sqrt(fit.covariance(3, 3))};
}

void check(std::span<const double> z) {
  const auto present = std::count_if(z.begin(), z.end(), [](double v) { return !std::isnan(v); });
  if (static_cast<std::size_t>(present) < fewest_samples)
    throw InputError("ARIMA fit", std::to_string(present) + " samples; at least " +
                                      std::to_string(fewest_samples) + " are needed");
  const auto first = std::find_if(z.begin(), z.end(), [](double v) { return !std::isnan(v); });
  if (std::all_of(first, z.end(), [&](double v) { return std::isnan(v) || v == *first; }))
    throw InputError("ARIMA fit", "the signal never changes from " + std::to_string(*first) + " dps");
}

}  // namespace

double arima_log_likelihood(const Arima111<double>& arima, std::span<const double> rate_dps) {
  double sum = 0.0;
  arima_innovations(arima, rate_dps, [&](double nu, double s) {
    sum += std::log(2.0 * std::numbers::pi * s) + nu * nu / s;
  });
  return -0.5 * sum;
}

ArimaFit fit_arima_likelihood(std::span<const double> rate_dps) {
  check(rate_dps);
  const auto starts = starting_points(rate_dps);
  const int terms = static_cast<int>(concentrate(starts.front().shape, rate_dps).count);

  ArimaFit fit;
  double best = std::numeric_limits<double>::infinity();
  Shape shape{};
  for (const auto& start : starts) {
    Shape candidate = start.shape;
    ceres::Problem problem;
    problem.AddResidualBlock(new PredictionErrors(rate_dps, terms), nullptr, candidate.data());
    for (int i = 0; i < 3; ++i) {
      const double limit = i < 2 ? shape_limit : log_ratio_limit;
      problem.SetParameterLowerBound(candidate.data(), i, -limit);
      problem.SetParameterUpperBound(candidate.data(), i, limit);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-9;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    fit.iterations += static_cast<int>(summary.iterations.size());
    if (!summary.IsSolutionUsable() || !(summary.final_cost < best)) continue;
    best = summary.final_cost;
    shape = candidate;
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
    fit.message = fit.converged ? "converged" : "did not converge: " + summary.message;
  }
  if (std::isinf(best)) {
    fit.message = "did not converge from any starting point";
    shape = starts.front().shape;
  }
  const auto sums = concentrate(shape, rate_dps);
  const double delta1 = std::sqrt(sums.squares / sums.count);
  const auto unit = unit_model(shape.data());
  fit.parameters = {unit.phi, delta1, unit.delta2_dps * delta1,
                    unit.measurement_noise_std_dps * delta1};
  fit.samples = rate_dps.size();
  fit.objective = arima_log_likelihood(fit.parameters, rate_dps);
  add_standard_errors(fit, rate_dps);
  return fit;
}

}  // namespace gyrostat
