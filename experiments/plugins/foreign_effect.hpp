#pragma once

#include <memory>
#include <span>

#include <gyrostat/experiments/plugins/description.hpp>
#include <gyrostat/experiments/plugins/workers.hpp>

namespace gyrostat {

/// An effect that runs in processes of its own.
///
/// Thread safety: any number of threads may apply it at once.
struct ForeignEffect {
  std::shared_ptr<const EffectDescription> description;
  std::shared_ptr<Workers> workers;

  /// Changes what its stage may change; nothing where a channel that it needs is absent. Throws
  /// WorkerFailure where the process fails or makes of a number what is none.
  void apply(std::span<const double> values, Series& series, const Noise& noise) const;
  /// The same by a given process.
  void apply_in(Worker& worker, std::span<const double> values, Series& series,
                const Noise& noise) const;
};

/// As an effect among those of ours.
EffectType effect_type_of(const ForeignEffect& effect);

}  // namespace gyrostat
