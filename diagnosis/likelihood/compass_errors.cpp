#include <gyrostat/diagnosis/likelihood/compass_errors.hpp>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/gap/recorders_way.hpp>
#include <gyrostat/diagnosis/likelihood/walking_level.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
CompassErrors::CompassErrors(const Conditions& conditions, const Series& recording)
    : conditions_(conditions), recording_(recording) {
  Series held;
  hold_influences(conditions.series(), held);
  turning_.t_s = std::move(held.t_s);
  turning_.rate_ref_dps = std::move(held.rate_ref_dps);
  const auto error = of({});
  double sine = 0.0, cosine = 0.0;
  for (const auto& span : conditions_.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(error[i])) {
        sine += std::sin(error[i] * std::numbers::pi / 180.0);
        cosine += std::cos(error[i] * std::numbers::pi / 180.0);
      }
  centre_deg_ = std::atan2(sine, cosine) * 180.0 / std::numbers::pi;
  shift_ = way_of_recorders(shift_of(of({}), {}, 0.0));
}

std::vector<double> CompassErrors::of(const std::vector<Effect>& effects) const {
  Scenario quiet;
  quiet.effects = effects;
  if (clock_) quiet.effects.emplace_back(*clock_);
  quiet.compass.initial_heading_deg = centre_deg_;
  Series ideal = turning_;
  turn_compass(quiet, {}, ideal);
  // Since the sample before, or until the next.
  const auto turned = [&, last = ideal.size() - 1](std::size_t i) {
    const std::size_t from = shift_ > 0.0 ? std::max<std::size_t>(i, 1) - 1 : i;
    const std::size_t to = shift_ > 0.0 ? i : std::min(i + 1, last);
    return shift_ * wrap_degrees(ideal.heading_deg[to] - ideal.heading_deg[from]);
  };
  // What was turned before the first and after the last sample, nobody knows.
  const auto& t_s = conditions_.series().t_s;
  const auto is_known = [&](std::size_t i) {
    if (!clock_) return true;
    const double then_s = t_s[i] - clock_->late_s(t_s, i);
    return then_s >= t_s.front() && then_s <= t_s.back();
  };
  std::vector<double> error(recording_.size(), no_value);
  for (std::size_t i = 0; i < error.size(); ++i)
    if (is_known(i) && !is_missing(recording_.heading_deg[i]) &&
        (recording_.mag_valid.empty() || recording_.mag_valid[i] > 0.5))
      error[i] = wrap_degrees(recording_.heading_deg[i] - ideal.heading_deg[i] + turned(i));
  return error;
}

void CompassErrors::take_clock(const Effect& time_offset) {
  clock_ = *time_offset.as<effects::TimeOffset>();
  clock_->of_compass = 1.0;
  shift_ = 0.0;
  shift_ = way_of_recorders(shift_of(of({}), {}, 0.0));
}

std::vector<double> CompassErrors::means_of(const std::vector<Effect>& effects) const {
  const auto error = of(effects);
  auto slow = conditions_.slow_means(error);
  const std::size_t cluster = conditions_.cluster();
  std::vector<double> known(slow.size(), 0.0), some = {0.0};
  for (std::size_t k = 0; k < slow.size(); ++k) {
    for (std::size_t i = k * cluster; i < std::min((k + 1) * cluster, error.size()); ++i)
      if (!is_missing(error[i])) known[k] += 1.0;
    if (known[k] > 0.0) some.push_back(known[k]);
  }
  // A compass may be slower than the gyro.
  const double usual = quantile(some, 0.5);
  for (std::size_t k = 0; k < slow.size(); ++k)
    if (2.0 * known[k] < usual) slow[k] = no_value;
  return slow;
}

double CompassErrors::shift_of(const std::vector<double>& error, const std::vector<char>& hidden,
                               double level_gain) const {
  const auto& rate = conditions_.series().rate_ref_dps;
  if (rate.empty()) return 0.0;
  std::vector<double> sizes;
  for (const double e : error)
    if (!is_missing(e)) sizes.push_back(std::abs(e));
  if (sizes.empty()) return 0.0;
  // Bursts say nothing of it.
  const double largest = std::max(3.0 * quantile(sizes, 0.75), 1e-12);
  WalkingLevel of_error(level_gain), of_rate(level_gain);
  double product = 0.0, square = 0.0;
  for (const auto& span : conditions_.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(error[i]) && std::abs(error[i]) < largest && !is_hidden(hidden, i)) {
        const double turned = of_rate.innovation(rate[i]);
        product -= of_error.innovation(error[i]) * turned;
        square += turned * turned;
      }
  return square > 0.0 ? product / (square * conditions_.interval_s()) : 0.0;
}

bool CompassErrors::is_hidden(const std::vector<char>& hidden, std::size_t sample) const {
  return !hidden.empty() &&
         hidden[std::min(sample / conditions_.cluster(), hidden.size() - 1)] != 0;
}

void CompassErrors::shift_beside(const std::vector<Effect>& effects,
                                 const std::vector<char>& hidden) {
  const auto errors = of(effects);
  const double gain = law_of_errors(errors, hidden).level_gain;
  shift_ = way_of_recorders(shift_ + shift_of(errors, hidden, gain));
}

CompassErrors::Law CompassErrors::law_of_errors(const std::vector<double>& errors,
                                                const std::vector<char>& hidden) const {
  struct AtGain {
    WalkingLevel level;
    double square = 0.0, lagged = 0.0, before = 0.0;
  };
  constexpr std::array gains = {0.0, 1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1};
  std::vector<AtGain> each;
  for (const double gain : gains) each.push_back({WalkingLevel(gain)});
  double count = 0.0;
  // All gains side by side: each waits for its own level, and none for another's.
  for (const auto& span : conditions_.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (is_missing(errors[i]) || is_hidden(hidden, i)) continue;
      count += 1.0;
      for (auto& at : each) {
        const double innovation = at.level.innovation(errors[i]);
        at.square += innovation * innovation;
        at.lagged += innovation * at.before;
        at.before = innovation;
      }
    }
  if (count < 10.0) return {0.0, 1.0, 0.0};
  const auto law_at = [&](std::size_t k) -> Law {
    const auto& [level, square, lagged, before] = each[k];
    // Neighbours that are alike count as fewer.
    const double alike = std::clamp(lagged / std::max(square, 1e-300), 0.0, 0.99);
    const double effective = count * (1.0 - alike) / (1.0 + alike);
    return {std::max(effective, 10.0), std::max(square / count, 1e-18), gains[k],
            level.log_known() / count};
  };
  constexpr double clear = 5.0;
  const Law still = law_at(0);
  Law best = still;
  for (std::size_t k = 1; k < gains.size(); ++k) {
    const Law law = law_at(k);
    if (law.gain_on(still) > clear && law.gain_on(best) > 0.0) best = law;
  }
  return best;
}

}  // namespace gyrostat::gap
