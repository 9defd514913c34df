#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

namespace gyrostat::cli {

/// As "[####......]".
std::string progress_bar(double share);

/// Calls `draw` five times a second until it is to stop.
void redraw(const std::stop_token& stop, const std::function<void()>& draw);

/// Tells how far a cell is: a bar on a terminal, a plain line every tenth elsewhere. Draws from its
/// own thread, so that trials never wait for it.
class Progress {
 public:
  Progress(std::ostream& out, bool is_terminal, std::string name, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// So many trials are done; the rest of the line is rate and time left.
  void set(std::size_t finished);
  /// The same, with the line said by the caller.
  void set(std::size_t finished, std::string line);

 private:
  void draw();

  std::ostream& out_;
  bool is_terminal_;
  std::string name_;
  std::size_t total_;
  std::size_t tenths_ = 0;
  std::atomic<std::size_t> finished_{0};
  std::mutex mutex_;
  std::string line_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::jthread thread_;
};

}  // namespace gyrostat::cli
