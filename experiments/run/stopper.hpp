#pragma once

#include <atomic>
#include <chrono>
#include <ctime>
#include <optional>
#include <string>
#include <thread>

namespace gyrostat {

/// One flag for all that ends a run in good order: an interrupt, an hour of the day, too many
/// failures.
class Stopper {
 public:
  explicit Stopper(const std::atomic<bool>& interrupt, std::optional<std::time_t> until = {})
      : watch_([this, &interrupt, until](const std::stop_token& end) {
          while (!end.stop_requested() && !stop_) {
            if (interrupt)
              stop("stopped early");
            else if (until && std::time(nullptr) >= *until)
              stop("stopped at the hour that was set");
            else
              std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        }) {}

  /// The first reason is the one that counts.
  void stop(const char* reason) {
    const char* none = nullptr;
    reason_.compare_exchange_strong(none, reason);
    stop_ = true;
  }
  const std::atomic<bool>& flag() const { return stop_; }
  std::string reason() const { return reason_.load(); }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<const char*> reason_{nullptr};
  std::jthread watch_;
};

}  // namespace gyrostat
