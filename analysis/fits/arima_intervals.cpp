#include <gyrostat/analysis/fits/arima_intervals.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <boost/math/tools/toms748_solve.hpp>
#include <ceres/jet.h>

#include <gyrostat/analysis/fits/arima_likelihood.hpp>
#include <gyrostat/analysis/fits/arima_sums.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>

namespace gyrostat {
namespace {

using Parameter = ArimaIntervals::Parameter;
/// What is free beside the held parameter, each over all real numbers.
using Free = std::array<double, 3>;

constexpr double smallest = 1e-9;     ///< of a standard deviation beside the largest of the model
constexpr double wald_is_good = 0.1;  ///< of a signed root, so far from where it should be

/// The model with one parameter held at `value`. |delta2| < delta1 throughout.
template <class T>
Arima111<T> model(Parameter held, double value, const T* u) {
  using std::exp;
  using std::sqrt;
  using std::tanh;
  const T v(value);
  switch (held) {
    case Parameter::phi: {
      const T delta1 = exp(u[0]);
      return {v, delta1, tanh(u[1]) * delta1, exp(u[2])};
    }
    case Parameter::delta1:
      return {tanh(u[0]), v, tanh(u[1]) * v, exp(u[2])};
    case Parameter::delta2:
      return {tanh(u[0]), sqrt(v * v + exp(T(2.0) * u[1])), v, exp(u[2])};
    default: {
      const T delta1 = exp(u[1]);
      return {tanh(u[0]), delta1, tanh(u[2]) * delta1, v};
    }
  }
}

/// Where `model` has these parameters, as nearly as it can.
Free coordinates(Parameter held, const Arima111<double>& p) {
  const double scale = std::hypot(p.delta1_dps, p.measurement_noise_std_dps);
  const auto log_of = [&](double std) { return std::log(std::max(std, smallest * scale)); };
  const auto inverse = [](double v) { return std::atanh(std::clamp(v, -0.9999, 0.9999)); };
  const double theta = p.delta1_dps > 0.0 ? p.theta() : 0.0;
  switch (held) {
    case Parameter::phi:
      return {log_of(p.delta1_dps), inverse(theta), log_of(p.measurement_noise_std_dps)};
    case Parameter::delta1:
      return {inverse(p.phi), inverse(theta), log_of(p.measurement_noise_std_dps)};
    case Parameter::delta2:
      return {inverse(p.phi), log_of(p.delta1_dps * std::sqrt(std::max(0.0, 1.0 - theta * theta))),
              log_of(p.measurement_noise_std_dps)};
    default:
      return {inverse(p.phi), log_of(p.delta1_dps), inverse(theta)};
  }
}

double value_of(Parameter parameter, const Arima111<double>& p) {
  return std::array{p.phi, p.delta1_dps, p.delta2_dps, p.measurement_noise_std_dps}[parameter];
}

/// Half of the deviance, up to a constant, with its gradient and expected curvature (Durbin and
/// Koopman 2012, sec. 7.3.5).
struct Misfit {
  double value = std::numeric_limits<double>::infinity();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

double misfit_of(const ArimaSums& sums) {
  const double misfit = sums.misfit();
  return std::isfinite(misfit) ? misfit : std::numeric_limits<double>::infinity();
}

std::vector<Misfit> misfits_about(std::span<const double> z, Parameter held, double value,
                                  std::span<const Free> points) {
  using Jet = ceres::Jet<double, 3>;
  std::vector<Arima111<double>> models;
  for (const auto& u : points) models.push_back(model(held, value, u.data()));
  const auto found = arima_derivatives(models, z);
  std::vector<Misfit> misfits;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& u = points[i];
    const std::array<Jet, 3> jets = {Jet(u[0], 0), Jet(u[1], 1), Jet(u[2], 2)};
    const auto at = model(held, value, jets.data());
    Eigen::Matrix<double, 4, 3> chain;
    chain << at.phi.v.transpose(), at.delta1_dps.v.transpose(), at.delta2_dps.v.transpose(),
        at.measurement_noise_std_dps.v.transpose();
    const Misfit misfit{.value = found[i].sums.misfit(),
                        .gradient = chain.transpose() * found[i].gradient(),
                        .information = chain.transpose() * found[i].information * chain};
    const bool finite = std::isfinite(misfit.value) && misfit.gradient.allFinite() &&
                        misfit.information.allFinite();
    misfits.push_back(finite ? misfit : Misfit{});
  }
  return misfits;
}

struct Lowest {
  double misfit = std::numeric_limits<double>::infinity();
  Free at{};
};

/// Fisher scoring to the least misfit, damped as by Marquardt: it says where to look next, and is
/// told what is there.
class Descent {
 public:
  explicit Descent(const Free& from) : next_(from) {}

  bool is_done() const { return done_; }
  const Free& next() const { return next_; }
  Lowest lowest() const { return {at_.value, u_}; }

  void take(const Misfit& there) {
    if (steps_ == 0) {
      at_ = there;
      u_ = next_;
    } else if (!(there.value < at_.value)) {
      damping_ *= 8.0;
    } else {
      done_ = damping_ < 1.0 && at_.value - there.value < enough;
      at_ = there;
      u_ = next_;
      damping_ *= 0.2;
    }
    done_ = done_ || steps_++ == most_steps || !std::isfinite(at_.value) || !(damping_ < 1e8);
    if (!done_) step();
  }

 private:
  static constexpr int most_steps = 60;
  static constexpr double enough = 1e-4;  ///< of half a deviance

  void step() {
    Eigen::Matrix3d damped = at_.information;
    damped.diagonal() *= 1.0 + damping_;
    damped.diagonal().array() += 1e-12 * damped.trace() + 1e-300;
    const Eigen::Vector3d step = damped.ldlt().solve(-at_.gradient).cwiseMax(-2.0).cwiseMin(2.0);
    done_ = !(-step.dot(at_.gradient) > 2.0 * enough);
    next_ = {u_[0] + step[0], u_[1] + step[1], u_[2] + step[2]};
  }

  Free next_, u_{};
  Misfit at_;
  double damping_ = 1e-2;
  int steps_ = 0;
  bool done_ = false;
};

/// Side by side: a pass over the signal for all of them takes hardly longer than for one.
void descend(std::span<const double> z, Parameter held, double value, std::span<Descent> descents) {
  for (;;) {
    std::vector<Descent*> going;
    std::vector<Free> next;
    for (auto& descent : descents)
      if (!descent.is_done()) going.push_back(&descent), next.push_back(descent.next());
    if (going.empty()) return;
    const auto there = misfits_about(z, held, value, next);
    for (std::size_t i = 0; i < going.size(); ++i) going[i]->take(there[i]);
  }
}

/// The least misfit with the parameter held there, from the most promising starting points.
Lowest least_misfit(std::span<const double> z, Parameter held, double value,
                    std::span<const Arima111<double>> starts) {
  constexpr std::size_t most_descents = 3;
  std::vector<Free> at;
  std::vector<Arima111<double>> models;
  for (const auto& start : starts) {
    at.push_back(coordinates(held, start));
    models.push_back(model(held, value, at.back().data()));
  }
  const auto sums = arima_sums(models, z);
  std::vector<std::pair<double, Free>> from;
  for (std::size_t i = 0; i < at.size(); ++i) from.emplace_back(misfit_of(sums[i]), at[i]);
  std::sort(from.begin(), from.end());
  from.resize(std::min(from.size(), most_descents));
  std::vector<Descent> descents;
  for (const auto& [misfit, u] : from) descents.emplace_back(u);
  descend(z, held, value, descents);
  Lowest least;
  for (const auto& descent : descents)
    if (descent.lowest().misfit < least.misfit) least = descent.lowest();
  return least;
}

/// The likeliest of models all over what is possible, each at the scale that suits the signal best.
std::vector<Arima111<double>> likely_models(std::span<const double> z) {
  constexpr std::size_t kept = 12;
  std::vector<Arima111<double>> grid;
  for (const double phi : {-0.6, 0.0, 0.6, 0.9})
    for (const double theta : {-0.9, -0.5, 0.0, 0.5, 0.9})
      for (const double noise : {0.01, 0.3, 1.0, 3.0, 10.0, 100.0, 1000.0})
        grid.push_back({phi, 1.0, theta, noise});
  const auto sums = arima_sums(grid, z);
  std::vector<std::pair<double, std::array<double, 4>>> models;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double scale = std::sqrt(sums[i].squares / sums[i].count);
    const auto& [phi, one, theta, noise] = grid[i];
    models.push_back({sums[i].logs + sums[i].count * std::log(sums[i].squares),
                      {phi, scale, theta * scale, noise * scale}});
  }
  std::sort(models.begin(), models.end());
  std::vector<Arima111<double>> likely;
  for (std::size_t k = 0; k < kept; ++k) {
    const auto& [phi, delta1, delta2, noise] = models[k].second;
    likely.push_back({phi, delta1, delta2, noise});
  }
  return likely;
}

}  // namespace

ArimaIntervals::ArimaIntervals(const ArimaFit& fit, std::span<const double> rate_dps)
    : z_(rate_dps),
      reported_(fit.parameters),
      errors_(fit.standard_errors),
      starts_(likely_models(rate_dps)) {
  const auto whole = fit_whole_arima_likelihood(rate_dps).parameters;
  starts_.push_back(whole);
  least_ = misfit_of(arima_sums(whole, z_));
  needed_ = 2.0 * (misfit_of(arima_sums(reported_, z_)) - least_);
  find_other_modes();
}

double ArimaIntervals::deviance(Parameter parameter, double value) const {
  return std::max(0.0, 2.0 * (least_misfit(z_, parameter, value, starts_).misfit - least_));
}

void ArimaIntervals::find_other_modes() {
  constexpr std::array grid = {-0.99, -0.9, -0.6, -0.2, 0.2, 0.6, 0.85, 0.95, 0.99};
  constexpr double ridge = 0.5;  // of deviance, more than a descent leaves
  const double most = chi_squared_quantile(0.95, 4.0);
  const auto above = std::lower_bound(grid.begin(), grid.end(), reported_.phi);
  const auto look = [&](auto from, auto to) {
    double highest = needed_;  // since the last mode
    bool falls = false;
    for (; from != to; ++from) {
      const auto found = least_misfit(z_, phi, *from, starts_);
      const double height = std::max(0.0, 2.0 * (found.misfit - least_));
      if (height > highest) falls = false;
      if (height < std::min(highest - ridge, most)) {
        if (falls) other_modes_.pop_back();
        other_modes_.push_back({model(phi, *from, found.at.data()), height});
        falls = true;
        highest = height;
      }
      highest = std::max(highest, height);
    }
  };
  look(above, grid.end());
  look(std::make_reverse_iterator(above), grid.rend());
  for (const auto& mode : other_modes_) needed_ = std::max(needed_, mode.deviance);
}

double ArimaIntervals::end(Parameter parameter, double limit, double reach) const {
  double estimate = value_of(parameter, reported_);
  const double side = limit > estimate ? 1.0 : -1.0;
  for (const auto& mode : other_modes_)
    estimate = side * std::max(side * estimate, side * value_of(parameter, mode.parameters));
  const auto excess = [&](double v) {
    return v == estimate ? -reach : std::sqrt(deviance(parameter, v)) - reach;
  };

  // A parabola would have it here, where the fit is its bottom.
  const double error = value_of(parameter, errors_);
  const double typical = parameter == phi ? 0.2 : 0.5 * starts_.back().delta1_dps;
  const bool has_error = std::isfinite(error) && error > 0.0;
  double step = has_error ? reach * error : typical;
  const auto within = [&](double v) { return side * (limit - v) > 0.0; };
  if (has_error && needed_ < wald_is_good && within(estimate + side * step))
    if (const double miss = excess(estimate + side * step); std::abs(miss) < wald_is_good)
      return estimate + side * step * reach / (reach + miss);

  if (std::isfinite(limit) && !(excess(limit) > 0.0)) return limit;
  double far = estimate + side * step;
  for (int i = 0; i < 40 && within(far) && excess(far) < 0.0; ++i)
    far = estimate + side * (step *= 2.0);
  if (!within(far)) far = limit;
  const double ends[] = {std::min(estimate, far), std::max(estimate, far)};
  std::uintmax_t most = 20;
  const auto close = [&](double a, double b) {
    return std::abs(a - b) < 0.01 * std::abs(0.5 * (a + b) - estimate);
  };
  const auto found = boost::math::tools::toms748_solve(excess, ends[0], ends[1], close, most);
  return 0.5 * (found.first + found.second);
}

double ArimaIntervals::reach(double confidence) const {
  const double normal = normal_quantile(0.5 + 0.5 * confidence);
  return std::max(normal, 1.001 * std::sqrt(std::max(0.0, needed_)));
}

std::array<double, 2> ArimaIntervals::interval(Parameter parameter, double confidence) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  constexpr double most = 1.0 - 1e-5;  // of |phi|
  std::array<double, 2> limits = {0.0, none};
  if (parameter == phi) limits = {-most, most};
  if (parameter == delta2) limits = {-none, none};
  std::array<double, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    ends[i] = end(parameter, limits[i], reach(confidence));
    if (parameter == phi && ends[i] == limits[i]) ends[i] = std::round(ends[i]);
  }
  return ends;
}

}  // namespace gyrostat
