#pragma once

#include <chrono>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

namespace gyrostat::cli {

/// Tells how far work is that goes from phase to phase: on a terminal a bar that only grows, with
/// the time left, elsewhere one line a phase. Draws from its own thread, so that time goes on
/// between two sets.
class PhaseProgress {
 public:
  PhaseProgress(std::ostream& out, bool is_terminal, std::string name);
  ~PhaseProgress();
  PhaseProgress(const PhaseProgress&) = delete;
  PhaseProgress& operator=(const PhaseProgress&) = delete;

  /// `detail` of the phase is being done, and `share` of all work is.
  void set(const std::string& phase, const std::string& detail, double share);

 private:
  void draw();
  double elapsed_s() const;
  /// As ", about 40 s left"; empty while nobody can know.
  std::string time_left() const;

  std::ostream& out_;
  const bool is_terminal_;
  const std::string name_;
  std::mutex mutex_;
  std::string phase_, detail_;
  double share_ = 0.0;
  double end_s_ = 0.0;  ///< when all will be done, as it looked when the share last grew
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::jthread thread_;
};

}  // namespace gyrostat::cli
