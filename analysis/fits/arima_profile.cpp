#include <gyrostat/analysis/fits/arima_profile.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <ceres/jet.h>

namespace gyrostat {
namespace {

using Parameter = ArimaIntervals::Parameter;
/// What is free beside the held parameter, each over all real numbers.
using Free = std::array<double, 3>;

constexpr double smallest = 1e-9;  ///< of a standard deviation beside the largest of the model

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

/// Half of the deviance, up to a constant, with its gradient and expected curvature (Durbin and
/// Koopman 2012, sec. 7.3.5).
struct Misfit {
  double value = std::numeric_limits<double>::infinity();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

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

/// Fisher scoring to the least misfit, damped as by Marquardt: it says where to look next, and is
/// told what is there.
class Descent {
 public:
  explicit Descent(const Free& from) : next_(from) {}

  bool is_done() const { return done_; }
  const Free& next() const { return next_; }
  double misfit() const { return at_.value; }
  const Free& lowest() const { return u_; }

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

}  // namespace

double arima_misfit(const ArimaSums& sums) {
  const double misfit = sums.misfit();
  return std::isfinite(misfit) ? misfit : std::numeric_limits<double>::infinity();
}

LeastMisfit least_misfit(std::span<const double> z, Parameter held, double value,
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
  for (std::size_t i = 0; i < at.size(); ++i) from.emplace_back(arima_misfit(sums[i]), at[i]);
  std::sort(from.begin(), from.end());
  from.resize(std::min(from.size(), most_descents));
  std::vector<Descent> descents;
  for (const auto& [misfit, u] : from) descents.emplace_back(u);
  descend(z, held, value, descents);
  LeastMisfit least;
  for (const auto& descent : descents)
    if (descent.misfit() < least.misfit)
      least = {descent.misfit(), model(held, value, descent.lowest().data())};
  return least;
}

std::vector<Arima111<double>> likely_arima_models(std::span<const double> z) {
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

}  // namespace gyrostat
