#pragma once

#include <atomic>

namespace gyrostat::cli {

/// What SIGINT and SIGTERM do. The first one ends the program at once, with 128 + its number as
/// exit code and no file half-written. A verb that can come to an end in good order asks for that:
/// then a flag is set instead, and the verb has `grace` to end. A second signal never waits.
///
/// One a process; members may be called from any thread.
class StopSignal {
 public:
  /// Seconds; with what it takes to end, less than one.
  static constexpr double grace_s = 0.8;

  /// From now on signals are caught.
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// What becomes of what a verb has done when it is ended.
  enum class Done { is_kept, is_discarded };
  /// The flag that the first signal sets from now on: the verb then ends with the exit code
  /// `stopped`, and is ended with it where it has not in time.
  const std::atomic<bool>& orderly(Done done);
};

}  // namespace gyrostat::cli
