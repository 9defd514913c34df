#include <gyrostat/diagnosis/starts/late_filter.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/catalogue/sensor_bandwidth.hpp>
#include <gyrostat/diagnosis/catalogue/time_offset.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {
namespace {

struct LateFilter {
  effects::TimeOffset shift;
  effects::SensorBandwidth filter;

  std::vector<Effect> effects() const { return {shift, filter}; }
};

enum class Of { shift, both };

/// By Gauss and Newton, the shift, the rate before the first sample and the cutoff with them; what
/// is left.
double fitted(const Evidence& e, const Eigen::VectorXd& seen, Of what, int steps, LateFilter& fit) {
  const double step_s = 0.02 * e.conditions().interval_s();
  constexpr double share = 0.01, furthest = 0.3;  // of the cutoff, and of its logarithm
  double least = -1.0;
  auto trial = fit;
  for (int k = 0;; ++k) {
    auto later = trial, begun = trial, faster = trial;
    later.shift.offset_s += step_s;
    begun.filter.before_dps += 1.0;
    faster.filter.cutoff_hz *= 1.0 + share;
    std::vector sets{trial.effects(), later.effects(), begun.effects()};
    if (what == Of::both) sets.push_back(faster.effects());
    auto columns = signatures_of_sets(e, Trace::rate, sets);
    const Eigen::VectorXd left = seen - columns.col(0);
    if (least >= 0.0 && !(left.squaredNorm() < least)) return least;
    least = left.squaredNorm();
    fit = trial;
    if (k == steps) return least;
    for (Eigen::Index c = 1; c < columns.cols(); ++c) columns.col(c) -= columns.col(0);
    const auto by = match(columns.rightCols(columns.cols() - 1), left).amplitudes;
    trial.shift.offset_s += by[0] * step_s;
    trial.filter.before_dps += by[1];
    if (what == Of::both)
      trial.filter.cutoff_hz *= std::exp(std::clamp(by[2] * share, -furthest, furthest));
  }
}

/// Come to rest at the first sample's rate, where another does not leave clearly less.
LateFilter as_begun(const Evidence& e, const Eigen::VectorXd& seen, const LateFilter& fit) {
  constexpr double clear_gain = 10.0;
  auto other = fit;
  other.filter.before_dps = 0.0;
  const auto columns = signatures_of_sets(e, Trace::rate, {fit.effects(), other.effects()});
  const double gain =
      0.5 * static_cast<double>(columns.rows()) *
      std::log((seen - columns.col(1)).squaredNorm() / (seen - columns.col(0)).squaredNorm());
  return gain > clear_gain ? fit : other;
}

}  // namespace

std::vector<std::vector<Effect>> late_filters(const Evidence& evidence) {
  const double rate_hz = evidence.conditions().rate_hz();
  const auto seen = trace_of(evidence, Trace::rate);
  const double late_s = Diagnosed<effects::TimeOffset>::starts(evidence).front().offset_s;
  std::vector<std::vector<Effect>> all;
  for (const auto& form : {effects::SensorBandwidth{},
                           effects::SensorBandwidth{.poles = 2.0, .maximally_flat = 1.0}}) {
    LateFilter best;
    double least = -1.0;
    for (const double straight : {0.0, 1.0}) {
      const auto at = [&](double cutoff_hz) {
        LateFilter both{{.offset_s = late_s, .straight = straight}, form};
        both.filter.cutoff_hz = cutoff_hz;
        both.shift.offset_s -= Diagnosed<effects::SensorBandwidth>::delay_s_of(both.filter);
        return both;
      };
      auto both = at(best_of(0.01 * rate_hz, 0.45 * rate_hz, [&](double cutoff_hz) {
        auto trial = at(cutoff_hz);
        return fitted(evidence, seen, Of::shift, 1, trial);
      }));
      fitted(evidence, seen, Of::shift, 2, both);
      const double left = fitted(evidence, seen, Of::both, 8, both);
      if (least >= 0.0 && !(left < least)) continue;
      least = left;
      best = both;
    }
    all.push_back(as_begun(evidence, seen, best).effects());
  }
  return all;
}

}  // namespace gyrostat::gap
