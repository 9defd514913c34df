#pragma once

#include <memory>
#include <span>

#include <gyrostat/core/track.hpp>
#include <gyrostat/experiments/plugins/description.hpp>
#include <gyrostat/experiments/plugins/protocol.hpp>
#include <gyrostat/experiments/plugins/workers.hpp>

namespace gyrostat {

/// A filter that runs in processes of its own.
///
/// Thread safety: any number of threads may run it at once.
struct ForeignFilter {
  std::shared_ptr<const FilterDescription> description;
  std::shared_ptr<Workers> workers;

  /// Runs it from its start over every sample. Throws WorkerFailure, with the samples that it was
  /// about, where the process fails or answers what no filter may.
  void run(std::span<const double> values, const Series& series, Track& track) const;
};

/// One trial of a filter's process.
class ForeignTrial {
 public:
  /// A filter at its start. `other`: beside one that is under way; libraries alone can do that.
  ForeignTrial(const FilterDescription& filter, Worker& worker, std::span<const double> values,
               bool other = false);

  /// The next samples of the series, into the track, which has room for them.
  void step(const Series& series, std::size_t first, std::size_t count, Track& track);
  /// The trial is over, and all that was written was asked for.
  void end();

 private:
  void ask(std::size_t count);

  const FilterDescription& filter_;
  Worker& worker_;
  bool other_;
  std::vector<double> question_, answer_;
};

/// All of a series, in blocks of so many samples.
void run_trial_in_blocks(ForeignTrial& trial, const Series& series, Track& track,
                         std::size_t samples = protocol::samples_of_a_block);

/// As a filter among those of ours.
FilterType filter_type_of(const ForeignFilter& filter);

}  // namespace gyrostat
