#include <gyrostat/experiments/run/method_in_lanes.hpp>

#include <algorithm>
#include <array>
#include <tuple>

namespace gyrostat {
namespace {

/// The same columns, so many numbers further on.
PackedSteps further(const PackedSteps& steps, std::size_t by) {
  return {.estimate_dps = steps.estimate_dps + by,
          .estimate_variance = steps.estimate_variance + by,
          .innovation_dps = steps.innovation_dps + by,
          .innovation_variance = steps.innovation_variance + by,
          .status = steps.status + by};
}

}  // namespace

const PackedFilter* kernel_of(const Method& method, const Stretch& stretch) {
  if (method.type().needs.truth && !stretch.tells_truth()) return nullptr;
  return packed_filter(method.filter, stretch.lanes());
}

MethodInLanes::MethodInLanes(const Method& method, const PackedFilter& kernel,
                             std::span<const ParameterMap> told)
    : kernel_(&kernel), judge_(judge_kernel(kernel.lanes)), trials_(told.size()) {
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  PackMemory memory;
  double* parameters = nullptr;
  for (std::size_t l = 0; l < lanes; ++l) {
    const auto values =
        field_values(method.type(), told[std::min(l, trials_ - 1)], method.overrides);
    if (l == 0) parameters = memory.doubles(values.size() * lanes);
    for (std::size_t f = 0; f < values.size(); ++f) parameters[f * lanes + l] = values[f];
  }
  kernel.start(filter_state_.bytes(kernel.bytes), parameters);
  learned_first_.resize(lanes);
  if (kernel.learned != nullptr) kernel.learned(filter_state_.bytes(), learned_first_.data());
  start_judge();
}

MethodInLanes::MethodInLanes(const Method& method, std::span<const ParameterMap> told, int lanes)
    : judge_(judge_kernel(lanes)), trials_(told.size()) {
  for (const auto& parameters : told) {
    running_.push_back(
        method.type().start(field_values(method.type(), parameters, method.overrides)));
    learned_first_.push_back(running_.back()->learned());
  }
  const bool all_hold = std::all_of(running_.begin(), running_.end(),
                                    [](const auto& filter) { return filter->held().has_value(); });
  if (all_hold) hold_ = hold_kernel(lanes);
  if (hold_ != nullptr) {
    filter_state_.doubles(held_numbers * static_cast<std::size_t>(lanes));
    for (std::size_t l = 0; l < static_cast<std::size_t>(lanes); ++l) load_held(l);
  }
  start_judge();
}

MethodInLanes::MethodInLanes(std::span<const Track* const> tracks, int lanes)
    : judge_(judge_kernel(lanes)), trials_(tracks.size()), tracks_(tracks) {
  for (const Track* track : tracks) learned_first_.push_back(track->learned_first);
  start_judge();
}

void MethodInLanes::start_judge() { judge_->start(judge_state_.bytes(judge_->bytes)); }

void MethodInLanes::step(const Stretch& stretch) {
  if (kernel_ != nullptr)
    kernel_->run(filter_state_.bytes(), stretch.seen(), stretch.made(), stretch.samples());
  else if (hold_ != nullptr)
    hold_in_lanes(stretch);
  else if (!running_.empty())
    run_one_by_one(stretch, 0, stretch.samples());
  else
    copy_steps(stretch);
  judge_->add(judge_state_.bytes(), stretch.judged());
}

/// Epochs are each trial's own; what lies between them is the same few operations in every lane.
void MethodInLanes::hold_in_lanes(const Stretch& stretch) {
  const auto lanes = static_cast<std::size_t>(stretch.lanes());
  for (std::size_t k = 0; k < stretch.samples(); ++k) {
    const auto [t_s, gyro_dps, to] =
        std::tuple(stretch.judged().t_s + k * lanes, stretch.seen().gyro_dps + k * lanes,
                   further(stretch.made(), k * lanes));
    k += hold_->run(filter_state_.doubles(), t_s, gyro_dps, to, stretch.samples() - k);
    if (k == stretch.samples()) return;
    for (std::size_t l = 0; l < trials_; ++l) put_back_held(l);
    run_one_by_one(stretch, k, 1);
    for (std::size_t l = 0; l < lanes; ++l) load_held(l);
  }
}

/// Lanes that are left hold what the last trial does.
void MethodInLanes::load_held(std::size_t l) {
  const auto held = *running_[std::min(l, trials_ - 1)]->held();
  const std::array<double, held_numbers> numbers = {
      held.from_s,          held.least_s,      held.last_s,           held.turned_deg,
      held.compensated_dps, held.estimate_dps, held.estimate_variance};
  for (std::size_t i = 0; i < held_numbers; ++i)
    filter_state_.doubles()[i * static_cast<std::size_t>(judge_->lanes) + l] = numbers[i];
}

void MethodInLanes::put_back_held(std::size_t l) {
  const auto lanes = static_cast<std::size_t>(judge_->lanes);
  running_[l]->resume({.last_s = filter_state_.doubles()[2 * lanes + l],
                       .turned_deg = filter_state_.doubles()[3 * lanes + l]});
}

void MethodInLanes::run_one_by_one(const Stretch& stretch, std::size_t first, std::size_t samples) {
  const auto lanes = static_cast<std::size_t>(stretch.lanes());
  for (std::size_t l = 0; l < trials_; ++l)
    running_[l]->run(stretch.seen_by(l).from(first), further(stretch.made(), first * lanes + l),
                     lanes, samples);
}

void MethodInLanes::copy_steps(const Stretch& stretch) const {
  const auto& to = stretch.made();
  const auto lanes = static_cast<std::size_t>(stretch.lanes());
  for (std::size_t l = 0; l < lanes; ++l) {
    const Track& track = *tracks_[std::min(l, trials_ - 1)];
    for (std::size_t k = 0; k < stretch.samples(); ++k) {
      const std::size_t from = stretch.first() + k, at = k * lanes + l;
      to.estimate_dps[at] = track.estimate_dps[from];
      to.estimate_variance[at] = track.estimate_variance[from];
      to.innovation_dps[at] = track.innovation_dps[from];
      to.innovation_variance[at] = track.innovation_variance[from];
      to.status[at] = static_cast<double>(track.status[from]);
    }
  }
}

std::vector<TrackErrors> MethodInLanes::errors() {
  std::vector<TrackErrors> errors(static_cast<std::size_t>(judge_->lanes));
  judge_->finish(judge_state_.bytes(), errors.data());
  std::vector<LearnedParameters> learned(errors.size());
  if (kernel_ != nullptr && kernel_->learned != nullptr)
    kernel_->learned(filter_state_.bytes(), learned.data());
  for (std::size_t l = 0; l < running_.size(); ++l) learned[l] = running_[l]->learned();
  for (std::size_t l = 0; l < tracks_.size(); ++l) learned[l] = tracks_[l]->learned_last;
  for (std::size_t l = 0; l < trials_; ++l) {
    errors[l].learned_first = learned_first_[l];
    errors[l].learned_last = learned[l];
  }
  errors.resize(trials_);
  return errors;
}

}  // namespace gyrostat
