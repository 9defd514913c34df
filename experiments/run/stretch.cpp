#include <gyrostat/experiments/run/stretch.hpp>

#include <algorithm>

namespace gyrostat {

void* PackMemory::bytes(std::size_t count) {
  const std::size_t lines = (count + sizeof(Line) - 1) / sizeof(Line);
  if (lines_.size() < lines) lines_.resize(lines);
  return lines_.data();
}

Stretch::Stretch(std::span<const TrialSignal> signals, int lanes) : Stretch(lanes) {
  signals_ = signals;
}

Stretch::Stretch(SignalInLanes& made, bool heading) : Stretch(made.lanes()) {
  made_in_lanes_ = &made;
  heading_ = heading;
  // The same in every stretch, or not there.
  const auto& rate = made.conditions().rate_ref_dps;
  still_ = std::all_of(rate.begin(), rate.end(), [](double one) { return one == 0.0; });
}

Stretch::Stretch(int lanes) : lanes_(lanes) {
  constexpr int channels_seen = 7, channels_made = 5;
  memory_.doubles((channels_seen + channels_made) * static_cast<std::size_t>(lanes) *
                  JudgedSteps::most);
  made_ = {.estimate_dps = channel(channels_seen),
           .estimate_variance = channel(channels_seen + 1),
           .innovation_dps = channel(channels_seen + 2),
           .innovation_variance = channel(channels_seen + 3),
           .status = channel(channels_seen + 4)};
  steps_.estimate_dps = made_.estimate_dps;
  steps_.estimate_variance = made_.estimate_variance;
  steps_.innovation_dps = made_.innovation_dps;
  steps_.innovation_variance = made_.innovation_variance;
  steps_.status = made_.status;
}

bool Stretch::are_alike(std::span<const TrialSignal> signals) {
  const auto& first = *signals.front().series;
  return std::all_of(signals.begin(), signals.end(), [&](const TrialSignal& signal) {
    const auto& series = *signal.series;
    return series.size() == first.size() &&
           series.rate_ref_dps.empty() == first.rate_ref_dps.empty() &&
           series.thermal_bias_dps.empty() == first.thermal_bias_dps.empty() &&
           series.random_error_dps.empty() == first.random_error_dps.empty();
  });
}

void Stretch::load(std::size_t first) {
  first_ = first;
  steps_.samples = std::min(JudgedSteps::most, samples_of_all() - first);
  if (made_in_lanes_ != nullptr) return make();
  steps_.t_s = interleave(channel(0), &Series::t_s, &TrialSignal::series);
  seen_.gyro_dps = interleave(channel(1), &Series::gyro_dps, &TrialSignal::series);
  const auto& front = signals_.front();
  steps_.gyro_dps = front.judged == front.series
                        ? seen_.gyro_dps
                        : interleave(channel(2), &Series::gyro_dps, &TrialSignal::judged);
  steps_.true_rate_dps = interleave(channel(3), &Series::rate_ref_dps, &TrialSignal::series);
  steps_.true_drift_dps = interleave(channel(4), &Series::thermal_bias_dps, &TrialSignal::series);
  steps_.random_error_dps = interleave(channel(5), &Series::random_error_dps, &TrialSignal::series);
  seen_.true_rate_dps = steps_.true_rate_dps;
  seen_.true_drift_dps = steps_.true_drift_dps;
}

void Stretch::make() {
  auto& made = *made_in_lanes_;
  const auto& conditions = made.conditions();
  const auto spread = [&](int number, const std::vector<double>& values) {
    made.spread(values, first_, steps_.samples, channel(number));
    return channel(number);
  };
  steps_.t_s = spread(0, conditions.t_s);
  seen_.true_rate_dps = still_ && first_ > 0 && steps_.samples <= filled_
                            ? channel(3)
                            : spread(3, conditions.rate_ref_dps);
  filled_ = std::max(filled_, steps_.samples);
  steps_.true_rate_dps = still_ ? nullptr : channel(3);
  steps_.true_drift_dps = seen_.true_drift_dps = spread(4, conditions.thermal_bias_dps);
  made.gyro(first_, steps_.samples, channel(1), channel(5));
  steps_.gyro_dps = seen_.gyro_dps = channel(1);
  steps_.random_error_dps = channel(5);
  heading_made_ = false;
}

SampleColumns Stretch::seen_by(std::size_t l) const {
  if (made_in_lanes_ == nullptr) return columns_of(*signals_[l].series, first_);
  if (heading_ && !heading_made_) made_in_lanes_->heading(first_, steps_.samples, channel(6));
  heading_made_ = true;
  auto columns = columns_of(made_in_lanes_->conditions(), first_);
  columns.gyro_dps = seen_.gyro_dps + l;
  columns.heading_deg = heading_ ? channel(6) + l : nullptr;
  columns.gyro_stride = columns.heading_stride = static_cast<std::size_t>(lanes_);
  return columns;
}

const double* Stretch::interleave(double* to, const std::vector<double> Series::*channel,
                                  const Series* TrialSignal::*from) const {
  if ((signals_.front().*from->*channel).empty()) return nullptr;
  if (lanes_ == 1) return (signals_.front().*from->*channel).data() + first_;
  for (int l = 0; l < lanes_; ++l) {
    const auto& signal = signals_[std::min<std::size_t>(l, signals_.size() - 1)];
    const double* values = (signal.*from->*channel).data() + first_;
    for (std::size_t k = 0; k < steps_.samples; ++k) to[k * lanes_ + l] = values[k];
  }
  return to;
}

}  // namespace gyrostat
