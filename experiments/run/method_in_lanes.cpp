#include <gyrostat/experiments/run/method_in_lanes.hpp>

#include <algorithm>

namespace gyrostat {

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
  else if (!running_.empty())
    run_one_by_one(stretch);
  else
    copy_steps(stretch);
  judge_->add(judge_state_.bytes(), stretch.judged());
}

void MethodInLanes::run_one_by_one(const Stretch& stretch) {
  const auto& to = stretch.made();
  for (std::size_t l = 0; l < trials_; ++l)
    running_[l]->run(stretch.seen_by(l),
                     {.estimate_dps = to.estimate_dps + l,
                      .estimate_variance = to.estimate_variance + l,
                      .innovation_dps = to.innovation_dps + l,
                      .innovation_variance = to.innovation_variance + l,
                      .status = to.status + l},
                     static_cast<std::size_t>(stretch.lanes()), stretch.samples());
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
