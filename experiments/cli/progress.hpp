#pragma once

#include <atomic>
#include <chrono>
#include <ostream>
#include <string>
#include <thread>

namespace gyrostat::cli {

/// Tells how far a cell is: a bar with rate and time left on a terminal, a plain line every tenth
/// elsewhere. Draws from its own thread, so that trials never wait for it.
class Progress {
 public:
  Progress(std::ostream& out, bool is_terminal, std::string name, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void set(std::size_t finished) { finished_.store(finished, std::memory_order_relaxed); }

 private:
  void watch(const std::stop_token& stop);
  void draw(std::size_t finished);

  std::ostream& out_;
  bool is_terminal_;
  std::string name_;
  std::size_t total_;
  std::size_t tenths_ = 0;
  std::atomic<std::size_t> finished_{0};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::jthread thread_;
};

}  // namespace gyrostat::cli
