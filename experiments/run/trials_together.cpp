#include <gyrostat/experiments/run/trials_together.hpp>

#include <algorithm>
#include <chrono>
#include <new>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/target.hpp>
#include <gyrostat/experiments/run/method_in_lanes.hpp>
#include <gyrostat/experiments/run/outcome_numbers.hpp>
#include <gyrostat/experiments/run/stretch.hpp>

namespace gyrostat {
namespace {

/// What `work` threw; empty where it did not.
template <class Work>
std::string thrown_by(const Work& work) {
  try {
    work();
    return {};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& failure) {
    const std::string what = failure.what();
    return what.empty() ? "unknown" : what;
  }
}

void append(Record& record, const std::vector<double>& numbers, const std::string& thrown) {
  record.numbers.insert(record.numbers.end(), numbers.begin(), numbers.end());
  record.thrown.push_back(thrown);
}

/// The outcome of a method that threw.
void append_thrown(Record& record, const std::string& thrown) {
  std::vector<double> nothing(metric_types().size() + Outcome::beside_metrics, 0.0);
  std::fill_n(nothing.begin(), metric_types().size(), no_value);
  append(record, nothing, thrown);
}

using Clock = std::chrono::steady_clock;

class TrialsTogether {
 public:
  TrialsTogether(const Cell& cell, const Calibration& shared, std::span<const Noise> trials,
                 std::span<Workspace> lanes, const SharedConditions* conditions)
      : cell_(cell),
        shared_(shared),
        trials_(trials),
        lanes_(lanes),
        conditions_(can_stay_in_lanes(conditions) ? conditions : nullptr),
        own_(trials.size()),
        uncompensated_(trials.size(), no_value),
        numbers_(cell.methods.size()),
        records_(trials.size()) {
    lanes.front().seconds.resize(cell.methods.size());
    lanes.front().steps.resize(cell.methods.size());
  }

  void prepare() {
    for (std::size_t l = 0; l < trials_.size(); ++l) {
      auto& w = lanes_[l];
      if (conditions_ == nullptr) make_trial(cell_, trials_[l], w.series);
      if (cell_.calibration.each_trial && cell_.needs_calibration()) {
        own_[l] = calibrate_cell(cell_, trials_[l], w.calibration_series);
        records_[l].calibration_converged = own_[l].random_error.converged;
      }
      if (conditions_ != nullptr) continue;
      signals_.push_back({&w.series, &judged_series(cell_, w.series, w.denoised)});
      uncompensated_[l] = uncompensated_rmse(w.series);
    }
  }

  /// Methods `first` and on, `count` of them.
  void run(std::size_t first, std::size_t count) {
    const int together = lanes_for(trials_.size());
    if (conditions_ != nullptr) {
      SignalInLanes made(cell_.scenario, *conditions_, trials_, *signal_kernel(together));
      Stretch stretch(made, needs_heading());
      run(first, count, 0, trials_.size(), stretch);
    } else if (Stretch::are_alike(signals_) && judge_kernel(together) != nullptr) {
      Stretch stretch(signals_, together);
      run(first, count, 0, trials_.size(), stretch);
    } else {
      for (std::size_t l = 0; l < trials_.size(); ++l) {
        Stretch stretch(std::span<const TrialSignal>(signals_).subspan(l, 1), 1);
        run(first, count, l, 1, stretch);
      }
    }
    for (std::size_t m = first; m < first + count; ++m) {
      for (std::size_t l = 0; l < trials_.size(); ++l) append(records_[l], numbers_[m][l], "");
      numbers_[m].clear();
    }
  }

  std::vector<Record> records_of_all() { return std::move(records_); }
  Record& only() { return records_.front(); }

 private:
  static int lanes_for(std::size_t trials) {
    return static_cast<int>(*std::find_if(possible_lanes.begin(), possible_lanes.end() - 1,
                                          [&](std::uint32_t lanes) { return lanes >= trials; }));
  }

  /// Whether no more of these trials is needed at a time than a stretch.
  bool can_stay_in_lanes(const SharedConditions* conditions) const {
    const int lanes = lanes_for(trials_.size());
    return conditions != nullptr && SignalInLanes::can_draw(trials_) &&
           signal_kernel(lanes) != nullptr && judge_kernel(lanes) != nullptr &&
           std::none_of(cell_.methods.begin(), cell_.methods.end(),
                        [](const Method& method) { return needs_tracks(method); });
  }

  static bool needs_tracks(const Method& method) {
    return method.type().start == nullptr ||
           std::any_of(metric_types().begin(), metric_types().end(),
                       [](const MetricType& metric) { return metric.needs_track(); });
  }

  bool needs_heading() const {
    return std::any_of(cell_.methods.begin(), cell_.methods.end(),
                       [](const Method& method) { return method.type().needs.heading; });
  }

  /// The methods over `trials` trials from `from` on.
  void run(std::size_t first, std::size_t count, std::size_t from, std::size_t trials,
           Stretch& stretch) {
    std::vector<MethodInLanes> together;
    std::vector<std::size_t> which;
    for (std::size_t m = first; m < first + count; ++m) {
      const auto& method = cell_.methods[m];
      if (needs_tracks(method)) {
        run_tracks(m, from, trials, stretch);
        continue;
      }
      which.push_back(m);
      if (const auto* kernel = kernel_of(method, stretch))
        together.emplace_back(method, *kernel, told(m, from, trials));
      else
        together.emplace_back(method, told(m, from, trials), stretch.lanes());
    }
    run(which, together, from, trials, stretch);
  }

  /// A method that is given whole series, or judged by whole tracks: one trial after the other.
  void run_tracks(std::size_t m, std::size_t from, std::size_t trials, Stretch& stretch) {
    const auto start = Clock::now();
    const auto told_each = told(m, from, trials);
    std::vector<const Track*> tracks;
    for (std::size_t l = 0; l < trials; ++l) {
      auto& w = lanes_[from + l];
      track_method(cell_.methods[m], told_each[l], w.series, w.track);
      tracks.push_back(&w.track);
    }
    lanes_.front().seconds[m] += std::chrono::duration<double>(Clock::now() - start).count();
    std::vector<MethodInLanes> made;
    made.emplace_back(tracks, stretch.lanes());
    run(std::array{m}, made, from, trials, stretch);
  }

  /// All of them over one stretch after the other.
  void run(std::span<const std::size_t> which, std::vector<MethodInLanes>& methods,
           std::size_t from, std::size_t trials, Stretch& stretch) {
    if (which.empty()) return;
    auto& clock = lanes_.front();
    const std::size_t samples = stretch.samples_of_all();
    const auto lanes = static_cast<std::size_t>(stretch.lanes());
    std::vector<double> sums(2 * lanes);
    for (std::size_t first = 0; first < samples; first += JudgedSteps::most) {
      stretch.load(first);
      if (conditions_ != nullptr)
        judge_kernel(stretch.lanes())->uncompensated(stretch.judged(), sums.data());
      auto before = Clock::now();
      for (std::size_t i = 0; i < which.size(); ++i) {
        methods[i].step(stretch);
        const auto now = Clock::now();
        clock.seconds[which[i]] += std::chrono::duration<double>(now - before).count();
        before = now;
      }
    }
    for (std::size_t l = 0; conditions_ != nullptr && l < trials; ++l)
      uncompensated_[from + l] = uncompensated_rmse(sums[l], sums[lanes + l]);
    for (std::size_t i = 0; i < which.size(); ++i) {
      const auto errors = methods[i].errors();
      for (std::size_t l = from; l < from + trials; ++l)
        numbers_[which[i]].push_back(
            numbers_of(errors[l - from], uncompensated_[l],
                       {conditions_ != nullptr ? nullptr : signals_[l].judged, &lanes_[l].track}));
      clock.steps[which[i]] += static_cast<double>(samples * trials);
    }
  }

  std::vector<ParameterMap> told(std::size_t m, std::size_t from, std::size_t trials) const {
    std::vector<ParameterMap> told;
    Scenario drawn;
    for (std::size_t l = from; l < from + trials; ++l)
      told.push_back(
          told_parameters(cell_, sensor_of(cell_, trials_[l], drawn), cell_.methods[m],
                          cell_.calibration.each_trial ? own_[l] : shared_,
                          conditions_ != nullptr ? conditions_->series : lanes_[l].series));
    return told;
  }

  const Cell& cell_;
  const Calibration& shared_;
  std::span<const Noise> trials_;
  std::span<Workspace> lanes_;
  const SharedConditions* conditions_;  ///< null: trials are made as series
  std::vector<Calibration> own_;
  std::vector<TrialSignal> signals_;
  std::vector<double> uncompensated_;
  std::vector<std::vector<std::vector<double>>> numbers_;  ///< by method and trial
  std::vector<Record> records_;
};

}  // namespace

std::uint32_t default_lanes() {
  const int width = available_kernels().back()->width;
  return static_cast<std::uint32_t>(width < targets::Avx512::width ? width : 2 * width);
}

Record thrown_record(const Cell& cell, const std::string& thrown) {
  Record record;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) append_thrown(record, thrown);
  return record;
}

std::vector<Record> run_trials_together(const Cell& cell, const Calibration& shared,
                                        std::uint64_t seed, std::span<const std::uint32_t> trials,
                                        std::vector<Workspace>& workspaces,
                                        const SharedConditions* conditions) {
  std::vector<Noise> noises;
  for (const auto trial : trials) noises.push_back({seed, trial});
  return run_trials_together(cell, shared, noises, workspaces, conditions);
}

std::vector<Record> run_trials_together(const Cell& cell, const Calibration& shared,
                                        std::span<const Noise> trials,
                                        std::vector<Workspace>& workspaces,
                                        const SharedConditions* conditions) {
  if (workspaces.size() < trials.size()) workspaces.resize(trials.size());
  TrialsTogether together(cell, shared, trials, {workspaces.data(), trials.size()}, conditions);
  const bool alone = trials.size() == 1;
  auto thrown = thrown_by([&] { together.prepare(); });
  const bool prepared = thrown.empty();
  if (!alone && prepared) thrown = thrown_by([&] { together.run(0, cell.methods.size()); });
  for (std::size_t m = 0; alone && m < cell.methods.size(); ++m) {  // each throws for itself
    if (prepared) thrown = thrown_by([&] { together.run(m, 1); });
    if (!thrown.empty()) append_thrown(together.only(), thrown);
  }
  if (alone || thrown.empty()) return together.records_of_all();
  std::vector<Record> records;  // one by one, so that each is told of its own
  for (const auto& trial : trials) records.push_back(run_trial(cell, shared, trial, workspaces));
  return records;
}

Record run_trial(const Cell& cell, const Calibration& shared, const Noise& trial,
                 std::vector<Workspace>& workspaces) {
  return std::move(run_trials_together(cell, shared, {&trial, 1}, workspaces).front());
}

Record run_trial(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                 std::uint32_t trial, std::vector<Workspace>& workspaces) {
  return run_trial(cell, shared, Noise{seed, trial}, workspaces);
}

}  // namespace gyrostat
