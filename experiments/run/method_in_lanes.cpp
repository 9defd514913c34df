#include <gyrostat/experiments/run/method_in_lanes.hpp>

#include <algorithm>

namespace gyrostat {

const PackedFilter* kernel_of(const Method& method, const Stretch& stretch) {
  if (method.type().needs.truth &&
      (stretch.seen().true_rate_dps == nullptr || stretch.seen().true_drift_dps == nullptr))
    return nullptr;
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
  if (kernel.learned != nullptr) kernel.learned(filter_state_.bytes(0), learned_first_.data());
  start_judge();
}

MethodInLanes::MethodInLanes(std::span<const Track* const> tracks, int lanes)
    : judge_(judge_kernel(lanes)), trials_(tracks.size()), tracks_(tracks) {
  start_judge();
}

void MethodInLanes::start_judge() { judge_->start(judge_state_.bytes(judge_->bytes)); }

void MethodInLanes::step(const Stretch& stretch) {
  if (kernel_ != nullptr)
    kernel_->run(filter_state_.bytes(0), stretch.seen(), stretch.made(), stretch.samples());
  else
    copy_steps(stretch);
  judge_->add(judge_state_.bytes(0), stretch.judged());
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
  judge_->finish(judge_state_.bytes(0), errors.data());
  std::vector<LearnedParameters> learned(errors.size());
  if (kernel_ != nullptr && kernel_->learned != nullptr)
    kernel_->learned(filter_state_.bytes(0), learned.data());
  for (std::size_t l = 0; l < trials_; ++l) {
    errors[l].learned_first = kernel_ != nullptr ? learned_first_[l] : tracks_[l]->learned_first;
    errors[l].learned_last = kernel_ != nullptr ? learned[l] : tracks_[l]->learned_last;
  }
  errors.resize(trials_);
  return errors;
}

}  // namespace gyrostat
