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

  /// The flag that the first signal sets from now on. A verb that has not ended in time is ended
  /// with `exit_code`, by default 128 + the signal's number.
  const std::atomic<bool>& orderly(int exit_code = 0);
  /// 128 + the number of the signal that came.
  int exit_code() const;
};

}  // namespace gyrostat::cli
