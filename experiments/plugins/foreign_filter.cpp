#include <gyrostat/experiments/plugins/foreign_filter.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gyrostat {
namespace {

using protocol::numbers_of_a_sample;
using protocol::numbers_of_a_step;

/// What is wrong with a step; empty where nothing is.
std::string fault_of(const double* step) {
  const double estimate = step[0], variance = step[1], innovation = step[2];
  const double innovation_variance = step[3], status = step[4];
  if (!std::isfinite(estimate)) return fmt::format("an estimate of {} dps", estimate);
  if (std::isinf(variance) || variance < 0.0) return fmt::format("a variance of {} dps²", variance);
  if (std::isinf(innovation)) return fmt::format("an innovation of {} dps", innovation);
  if (std::isinf(innovation_variance) || innovation_variance <= 0.0)
    return fmt::format("an innovation variance of {} dps²", innovation_variance);
  if (!(status >= 0.0 && status < status_names.size()) || status != std::floor(status))
    return fmt::format("a status of {}", status);
  return "";
}

std::string where(std::size_t first, std::size_t count) {
  return count == 0 ? "at its end" : fmt::format("in samples {} to {}", first, first + count - 1);
}

}  // namespace

ForeignTrial::ForeignTrial(const FilterDescription& filter, Worker& worker,
                           std::span<const double> values, bool other)
    : filter_(filter), worker_(worker), other_(other) {
  question_ = {other ? protocol::start_other : protocol::start, static_cast<double>(values.size())};
  question_.insert(question_.end(), values.begin(), values.end());
  try {
    worker.exchange(question_, {});
  } catch (const WorkerFailure& failure) {
    throw WorkerFailure(fmt::format("{} at its start {}", filter_.name, failure.what()));
  }
}

void ForeignTrial::ask(std::size_t count) {
  question_[0] = other_ ? protocol::block_other : protocol::block;
  question_[1] = static_cast<double>(count);
  answer_.assign(1 + count * numbers_of_a_step, no_value);
  worker_.exchange(question_, answer_);
  if (answer_[0] != static_cast<double>(count))
    throw WorkerFailure(fmt::format("answered garbage: {} where the number of steps, {}, stands",
                                    answer_[0], count));
}

void ForeignTrial::step(const Series& series, std::size_t first, std::size_t count, Track& track) {
  question_.resize(2);
  for (std::size_t i = first; i < first + count; ++i) {
    const auto sample = sample_at(series, i);
    const bool sees_truth = filter_.needs.truth;
    question_.insert(question_.end(),
                     {sample.t_s, sample.gyro_dps, sample.temperature_C, sample.heading_deg,
                      sees_truth ? sample.true_rate_dps : no_value,
                      sees_truth ? sample.true_drift_dps : no_value});
  }
  try {
    ask(count);
  } catch (const WorkerFailure& failure) {
    throw WorkerFailure(fmt::format("{} {} {}", filter_.name, where(first, count), failure.what()));
  }
  for (std::size_t i = first; i < first + count; ++i) {
    const double* step = &answer_[1 + (i - first) * numbers_of_a_step];
    if (const auto fault = fault_of(step); !fault.empty())
      throw WorkerFailure(fmt::format("{} at sample {} gave {}", filter_.name, i, fault));
    track.estimate_dps[i] = step[0];
    track.estimate_variance[i] = step[1];
    track.innovation_dps[i] = step[2];
    track.innovation_variance[i] = step[3];
    track.status[i] = static_cast<Status>(static_cast<int>(step[4]));
  }
}

void ForeignTrial::end() {
  question_.resize(2);
  try {
    ask(0);
  } catch (const WorkerFailure& failure) {
    throw WorkerFailure(fmt::format("{} {} {}", filter_.name, where(0, 0), failure.what()));
  }
}

void run_trial_in_blocks(ForeignTrial& trial, const Series& series, Track& track,
                         std::size_t samples) {
  track.resize(series.size());
  track.learned_first = track.learned_last = {};
  for (std::size_t first = 0; first < series.size(); first += samples)
    trial.step(series, first, std::min(samples, series.size() - first), track);
  trial.end();
}

void ForeignFilter::run(std::span<const double> values, const Series& series, Track& track) const {
  workers->with_one([&](Worker& worker) {
    ForeignTrial trial(*description, worker, values);
    run_trial_in_blocks(trial, series, track);
  });
}

FilterType filter_type_of(const ForeignFilter& filter) {
  const auto& d = *filter.description;
  FilterType type;
  type.id = d.name;
  type.title = d.title;
  type.needs = d.needs;
  type.role = d.role;
  type.fields = d.fields;
  type.run = [filter](std::span<const double> values, const Series& series, Track& track) {
    filter.run(values, series, track);
  };
  type.code = filter.workers->code();
  return type;
}

}  // namespace gyrostat
