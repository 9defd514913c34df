#include <gyrostat/analysis/fits/arima_likelihood.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>
#include <ceres/ceres.h>

#include <gyrostat/analysis/fits/arima_shape.hpp>
#include <gyrostat/analysis/fits/arima_starts.hpp>
#include <gyrostat/analysis/fits/arima_sums.hpp>
#include <gyrostat/analysis/fits/arima_whittle.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/numerics/dense.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t fewest_samples = 50;

/// The prediction errors, whitened and scaled so that half of their sum of squares is what the
/// concentrated likelihood leaves to be minimised. Their number is that of the samples, but a
/// least-squares step knows them by their squares and products alone: four residuals with the same
/// squares and products stand for all.
class PredictionErrors final : public ceres::SizedCostFunction<4, 3> {
 public:
  explicit PredictionErrors(std::span<const double> z) : z_(z) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return jacobians && jacobians[0] ? evaluate(parameters[0], residuals, jacobians[0])
                                     : evaluate(parameters[0], residuals);
  }

 private:
  static double scale_of(const ArimaSums& sums) { return std::exp(0.5 * sums.logs / sums.count); }

  bool evaluate(const double* shape, double* residuals) const {
    const auto sums = arima_sums(unit_arima(shape), z_);
    std::fill_n(residuals, 4, 0.0);
    residuals[0] = std::sqrt(sums.squares) * scale_of(sums);
    return std::isfinite(residuals[0]);  // numbers that are none Ceres would print
  }

  bool evaluate(const double* at, double* residuals, double* jacobian) const {
    using Jet = ceres::Jet<double, 3>;
    const std::array<Jet, 3> shape = {Jet(at[0], 0), Jet(at[1], 1), Jet(at[2], 2)};
    const auto model = unit_arima(shape.data());
    const auto found = arima_derivatives(unit_arima(at), z_);
    Eigen::Matrix<double, 5, 4> chain = Eigen::Matrix<double, 5, 4>::Zero();
    chain.block<1, 3>(0, 0) = model.phi.v;
    chain.block<1, 3>(1, 0) = model.delta1_dps.v;
    chain.block<1, 3>(2, 0) = model.delta2_dps.v;
    chain.block<1, 3>(3, 0) = model.measurement_noise_std_dps.v;
    chain.block<1, 3>(4, 0) =
        0.5 / found.sums.count * found.logs.transpose() * chain.topLeftCorner<4, 3>();  // the scale
    chain(4, 3) = 1.0;
    chain *= scale_of(found.sums);
    const Eigen::Matrix4d products = chain.transpose() * found.products * chain;
    if (!products.allFinite()) return false;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> root(products);
    const Eigen::Matrix4d rows =
        root.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * root.eigenvectors().transpose();
    Eigen::Map<Eigen::Matrix<double, 4, 3, Eigen::RowMajor>>{jacobian} = rows.leftCols<3>();
    Eigen::Map<Eigen::Vector4d>{residuals} = rows.col(3);
    return true;
  }

  std::span<const double> z_;
};

constexpr ArimaVariant full = {true, true, true, "converged"};
/// Simpler models, simplest first, for signals that do not tell all four parameters.
constexpr std::array<ArimaVariant, 4> simpler = {{
    {false, false, true, "converged; phi and delta2 cannot be told and are held at 0"},
    {true, false, true, "converged; delta2 cannot be told and is held at 0"},
    {false, true, true, "converged; phi cannot be told and is held at 0"},
    {true, true, false, "converged; R cannot be told and is held at 0"},
}};

/// Covariance of the free ones of (phi, delta1, delta2, sqrt R); empty where they are not
/// identifiable.
std::optional<Eigen::Matrix4d> covariance_of(const Arima111<double>& arima,
                                             const ArimaVariant& variant,
                                             std::span<const double> z) {
  // R enters as a square, so its root has no information near zero, whatever the scale.
  if (variant.noise && arima.measurement_noise_std_dps < 1e-3 * arima.delta1_dps)
    return std::nullopt;
  const std::array<bool, 4> is_free = {variant.phi, true, variant.theta, variant.noise};
  std::vector<int> index;
  for (int i = 0; i < 4; ++i)
    if (is_free[i]) index.push_back(i);
  // Scaled to a unit diagonal, so that definiteness does not depend on units.
  const Eigen::MatrixXd info = arima_derivatives(arima, z).information(index, index);
  const Eigen::VectorXd scale = info.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const auto [inverse, pivots, positive] =
      invert_symmetric(scale.asDiagonal() * info * scale.asDiagonal());
  if (!positive || !(pivots.minCoeff() > 1e-8)) return std::nullopt;
  Eigen::Matrix4d covariance =
      Eigen::Vector4d::Constant(std::numeric_limits<double>::infinity()).asDiagonal();
  covariance(index, index) = scale.asDiagonal() * inverse * scale.asDiagonal();
  return covariance;
}

void check(std::span<const double> z) {
  const auto present = std::count_if(z.begin(), z.end(), [](double v) { return !std::isnan(v); });
  if (static_cast<std::size_t>(present) < fewest_samples)
    throw InputError("ARIMA fit", std::to_string(present) + " samples; at least " +
                                      std::to_string(fewest_samples) + " are needed");
  const auto first = std::find_if(z.begin(), z.end(), [](double v) { return !std::isnan(v); });
  if (std::all_of(first, z.end(), [&](double v) { return std::isnan(v) || v == *first; }))
    throw InputError("ARIMA fit", "the signal never changes from " + short_number(*first) + " dps");
}

}  // namespace

double arima_log_likelihood(const Arima111<double>& arima, std::span<const double> rate_dps) {
  const auto sums = arima_sums(arima, rate_dps);
  return -sums.misfit() - 0.5 * sums.count * std::log(2.0 * std::numbers::pi);
}

namespace {

/// The best of a few descents from the grid, with the held parameters at zero.
ArimaFit descend(std::span<const double> z, const ArimaVariant& variant) {
  const auto starts = arima_starts(z, variant);
  ArimaFit fit;
  double best = std::numeric_limits<double>::infinity();
  ArimaShape shape = starts.front();
  fit.message = "did not converge from any starting point";
  std::vector<int> held;
  if (!variant.phi) held.push_back(0);
  if (!variant.theta) held.push_back(1);
  if (!variant.noise) held.push_back(2);
  for (ArimaShape candidate : starts) {
    ceres::Problem problem;
    problem.AddResidualBlock(new PredictionErrors(z), nullptr, candidate.data());
    if (!held.empty()) problem.SetManifold(candidate.data(), new ceres::SubsetManifold(3, held));
    for (int i = 0; i < 3; ++i) {
      const double limit = i < 2 ? ArimaLimits::shape : ArimaLimits::log_ratio;
      problem.SetParameterLowerBound(candidate.data(), i, -limit);
      problem.SetParameterUpperBound(candidate.data(), i, limit);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-12;
    // Bounds make Ceres search along each step, which doubles the passes.
    if (z.size() >= ArimaWhittle::shortest) options.max_num_line_search_step_size_iterations = 0;
    options.parameter_tolerance = 1e-9;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    fit.iterations += static_cast<int>(summary.iterations.size());
    if (!summary.IsSolutionUsable() || !(summary.final_cost < best)) continue;
    best = summary.final_cost;
    shape = candidate;
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
    fit.message = fit.converged ? variant.message : "did not converge: " + summary.message;
  }
  const auto sums = arima_sums(unit_arima(shape.data()), z);
  const double delta1 = std::sqrt(sums.squares / sums.count);
  const auto unit = unit_arima(shape.data());
  fit.parameters = {unit.phi, delta1, unit.delta2_dps * delta1,
                    variant.noise ? unit.measurement_noise_std_dps * delta1 : 0.0};
  if (variant.theta && std::abs(shape[1]) > 0.99 * ArimaLimits::shape)
    fit.message += "; |delta2| = delta1, the limit: x does not wander";
  fit.samples = z.size();
  fit.objective = arima_log_likelihood(fit.parameters, z);
  Eigen::Map<Eigen::Matrix4d> fitted(fit.covariance[0].data());
  if (const auto covariance = covariance_of(fit.parameters, variant, z)) {
    fitted = *covariance;
  } else {
    fitted = Eigen::Vector4d::Constant(std::numeric_limits<double>::infinity()).asDiagonal();
    fit.message += "; the parameters are not all identifiable";
  }
  fit.standard_errors = {std::sqrt(fitted(0, 0)), std::sqrt(fitted(1, 1)), std::sqrt(fitted(2, 2)),
                         std::sqrt(fitted(3, 3))};
  return fit;
}

/// Whether the free parameters are told at all: phi to a part of what it can be, white noise to
/// less than all that there is in a sample.
bool is_identified(const ArimaFit& fit, const ArimaVariant& variant) {
  const auto& [phi, delta1, delta2, noise] = fit.standard_errors;
  return std::isfinite(delta1) && (!variant.phi || phi <= 1.0) &&
         (!variant.noise ||
          noise <= std::hypot(fit.parameters.delta1_dps, fit.parameters.measurement_noise_std_dps));
}

}  // namespace

ArimaFit fit_whole_arima_likelihood(std::span<const double> rate_dps) {
  check(rate_dps);
  ArimaFit whole = descend(rate_dps, full);
  whole.likeliest = whole.parameters;
  return whole;
}

ArimaFit fit_walk_likelihood(std::span<const double> rate_dps) {
  check(rate_dps);
  return descend(rate_dps, simpler.front());
}

ArimaFit fit_arima_likelihood(std::span<const double> rate_dps) {
  const ArimaFit whole = fit_whole_arima_likelihood(rate_dps);
  if (is_identified(whole, full)) return whole;
  for (const auto& variant : simpler) {
    ArimaFit fit = descend(rate_dps, variant);
    fit.likeliest = whole.parameters;
    const double loss = 2.0 * (whole.objective - fit.objective);
    if (fit.converged && is_identified(fit, variant) &&
        loss < chi_squared_quantile(0.99, variant.held()))
      return fit;
  }
  return whole;
}

}  // namespace gyrostat
