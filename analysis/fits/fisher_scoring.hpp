#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <ceres/jet.h>

#include <gyrostat/analysis/fits/arima_whittle.hpp>

namespace gyrostat {

/// Fisher scoring over N free numbers to the least misfit of ARIMA(1,1,1) + white noise, damped as
/// by Marquardt: it says where to look next, and is told what is there.
template <int N>
class FisherScoring {
 public:
  using Free = std::array<double, N>;

  explicit FisherScoring(const Free& from) : next_(from) {}

  bool is_done() const { return done_; }
  const Free& next() const { return next_; }
  double misfit() const { return value_; }
  const Free& lowest() const { return u_; }
  /// Whether it ended where `other` did, to a tenth of a standard error.
  bool ended_as(const FisherScoring& other) const {
    const Step apart = Eigen::Map<const Step>(u_.data()) - Eigen::Map<const Step>(other.u_.data());
    return apart.dot(information_ * apart) < 0.01;
  }

  /// What there is at `next`, with what each of the model's parameters changes by the free numbers.
  void take(const ArimaMisfit& there, const Eigen::Matrix<double, 4, N>& chain) {
    const Step gradient = chain.transpose() * there.gradient;
    const Curvature information = chain.transpose() * there.information * chain;
    const bool is_finite =
        std::isfinite(there.value) && gradient.allFinite() && information.allFinite();
    const double fall = value_ - (is_finite ? there.value : infinity);
    const bool is_first = steps_++ == 0;
    if (is_first || fall > 0.0) {
      done_ = !is_first && damping_ < 1.0 && fall < enough;
      value_ = is_finite ? there.value : infinity;
      gradient_ = gradient;
      information_ = information;
      u_ = next_;
      if (!is_first) damping_ *= 0.2;
    } else {
      damping_ *= 8.0;
    }
    done_ = done_ || steps_ > most_steps || !std::isfinite(value_) || !(damping_ < 1e8);
    if (!done_) step();
  }

 private:
  using Step = Eigen::Matrix<double, N, 1>;
  using Curvature = Eigen::Matrix<double, N, N>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int most_steps = 60;
  static constexpr double enough = 1e-4;  ///< of half a deviance

  void step() {
    Curvature damped = information_;
    damped.diagonal() *= 1.0 + damping_;
    damped.diagonal().array() += 1e-12 * damped.trace() + 1e-300;
    const Step step = damped.ldlt().solve(-gradient_).cwiseMax(-2.0).cwiseMin(2.0);
    done_ = !(-step.dot(gradient_) > 2.0 * enough);
    Eigen::Map<Step>(next_.data()) = Eigen::Map<const Step>(u_.data()) + step;
  }

  Free next_, u_{};
  double value_ = infinity;
  Step gradient_ = Step::Zero();
  Curvature information_ = Curvature::Zero();
  double damping_ = 1e-2;
  int steps_ = 0;
  bool done_ = false;
};

/// Where descents from each of `from` end, the lowest first. `chart` makes a model of what is free;
/// `misfits` are those of several models, which share a pass over the signal.
template <int N, class Chart, class Misfits>
std::vector<FisherScoring<N>> descend(const std::vector<std::array<double, N>>& from,
                                      const Chart& chart, const Misfits& misfits) {
  using Jet = ceres::Jet<double, N>;
  std::vector<FisherScoring<N>> descents(from.begin(), from.end());
  for (;;) {
    std::vector<FisherScoring<N>*> going;
    std::vector<Arima111<double>> next;
    for (auto& descent : descents)
      if (!descent.is_done()) {
        going.push_back(&descent);
        next.push_back(chart(descent.next().data()));
      }
    if (going.empty()) break;
    const auto there = misfits(next);
    for (std::size_t i = 0; i < going.size(); ++i) {
      std::array<Jet, N> jets;
      for (int k = 0; k < N; ++k) jets[k] = Jet(going[i]->next()[k], k);
      const auto at = chart(jets.data());
      Eigen::Matrix<double, 4, N> chain;
      chain << at.phi.v.transpose(), at.delta1_dps.v.transpose(), at.delta2_dps.v.transpose(),
          at.measurement_noise_std_dps.v.transpose();
      going[i]->take(there[i], chain);
    }
  }
  std::stable_sort(descents.begin(), descents.end(),
                   [](const auto& a, const auto& b) { return a.misfit() < b.misfit(); });
  return descents;
}

/// Of descents by the spectrum, lowest first: up to `most` different ends between which it does not
/// decide, for the exact likelihood to go on from.
template <int N>
std::vector<std::array<double, N>> different_ends(const std::vector<FisherScoring<N>>& descents,
                                                  std::size_t most) {
  constexpr double undecided = 10.0;  // of half a deviance
  std::vector<const FisherScoring<N>*> kept;
  for (const auto& descent : descents) {
    if (kept.size() == most || descent.misfit() > descents.front().misfit() + undecided) break;
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const auto* other) { return descent.ended_as(*other); }))
      kept.push_back(&descent);
  }
  std::vector<std::array<double, N>> ends;
  for (const auto* one : kept) ends.push_back(one->lowest());
  return ends;
}

}  // namespace gyrostat
