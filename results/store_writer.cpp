#include <gyrostat/results/store_writer.hpp>

#include <algorithm>
#include <chrono>

namespace gyrostat {
namespace {

constexpr std::size_t most_waiting = 4096;
/// So long trials are collected before they are written: what a kill may cost.
constexpr auto batch_time = std::chrono::milliseconds(50);

}  // namespace

StoreWriter::StoreWriter(Store& store, Written written)
    : store_(store), written_(std::move(written)), thread_([this] { work(); }) {}

StoreWriter::~StoreWriter() {
  try {
    finish();
  } catch (...) {  // whoever wants to know calls finish
  }
}

void StoreWriter::push(TrialRow row) {
  std::unique_lock lock(mutex_);
  taken_.wait(lock, [&] { return failure_ || queue_.size() < most_waiting; });
  if (failure_) std::rethrow_exception(failure_);
  queue_.push_back(std::move(row));
  if (queue_.size() == most_waiting) came_.notify_one();
}

void StoreWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  came_.notify_one();
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void StoreWriter::work() {
  std::vector<TrialRow> batch;
  for (bool last = false; !last;) {
    batch.clear();
    {
      std::unique_lock lock(mutex_);
      came_.wait_for(lock, batch_time, [&] { return finished_ || queue_.size() >= most_waiting; });
      last = finished_;
      batch.swap(queue_);
    }
    taken_.notify_all();
    if (batch.empty()) continue;
    std::sort(batch.begin(), batch.end(), [](const TrialRow& a, const TrialRow& b) {
      return std::pair(a.cell, a.trial) < std::pair(b.cell, b.trial);
    });
    try {
      store_.write(batch);
      if (written_) written_(batch);
    } catch (...) {
      {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
      }
      taken_.notify_all();
      return;
    }
  }
}

}  // namespace gyrostat
