#pragma once

#include <atomic>
#include <stdexcept>

namespace gyrostat {

/// Thrown out of long work whose end was asked for before it was done.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("stopped before the end") {}
};

/// Whether the end of long work was asked for; by default nobody does.
///
/// Example: work that ends within one step of being asked to.
///
///   std::atomic<bool> stop{false};
///   const Interrupt interrupt(stop);
///   try {
///     for (int step = 0; step < 100; ++step) interrupt.check();
///   } catch (const Interrupted&) {
///     std::puts("stopped");
///   }
///
/// Thread safety: any number of threads may check, whichever sets the flag.
class Interrupt {
 public:
  Interrupt() = default;
  /// `stop` is looked at, and outlives this.
  explicit Interrupt(const std::atomic<bool>& stop) : stop_(&stop) {}

  /// Throws Interrupted once the flag is set.
  void check() const {
    if (stop_ != nullptr && *stop_) throw Interrupted();
  }

 private:
  const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace gyrostat
