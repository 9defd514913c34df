#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// The one thread that writes: trials come from any thread, and go into the store in batches, one
/// transaction each. Who is faster than the disk waits in `push`, so memory stays bounded.
class StoreWriter {
 public:
  /// Called in the writing thread behind each batch.
  using Written = std::function<void(std::span<const TrialRow>)>;

  explicit StoreWriter(Store& store, Written written = {});
  ~StoreWriter();
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  /// Throws what ended the writing, if something did.
  void push(TrialRow row);
  /// Returns when everything that was pushed is in the store; throws like `push`.
  void finish();

 private:
  void work();

  Store& store_;
  Written written_;
  std::mutex mutex_;
  std::condition_variable came_, taken_;
  std::vector<TrialRow> queue_;
  bool finished_ = false;
  std::exception_ptr failure_;
  std::jthread thread_;
};

}  // namespace gyrostat
