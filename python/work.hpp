#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

namespace gyrostat::python {

namespace py = pybind11;

/// Long work on a thread of its own, as the thread that waits for it knows it.
class Work {
 public:
  /// Set once its end is asked for.
  std::atomic<bool> stop{false};

  /// How far it is, for those who watch: what is being done, and which share of it is. From any
  /// thread; the latest one counts.
  void tell(std::string what, double share);

 private:
  friend void wait_for(const std::shared_ptr<Work>&, const std::function<void(Work&)>&, bool,
                       const py::object&);
  friend void wait_for_abandoned();
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::exception_ptr thrown_;
  std::optional<std::pair<std::string, double>> news_;
};

/// Does `job` on another thread without the interpreter's lock. The calling thread looks for Ctrl-C
/// and hands what the job tells to `progress(what, share)` (None: nobody listens), both several
/// times a second. Ctrl-C sets `work->stop`: a job that heeds it is waited for, any other is left
/// to end by itself. Throws what the job threw, or KeyboardInterrupt. `job` holds no Python object
/// and nothing of the caller's stack.
void wait_for(const std::shared_ptr<Work>& work, const std::function<void(Work&)>& job,
              bool heeds_stop, const py::object& progress);

/// Jobs that Ctrl-C left behind may still use the interpreter: at its exit they are waited for.
void wait_for_abandoned();

/// The result of a job that looks at no flag.
template <class Job>
auto result_of(Job job) {
  using Result = decltype(job());
  auto result = std::make_shared<std::optional<Result>>();
  wait_for(
      std::make_shared<Work>(), [job = std::move(job), result](Work&) { result->emplace(job()); },
      false, py::none());
  return std::move(**result);
}

/// The result of a job that ends in good order once the flag of its Work is set.
template <class Job>
auto result_of(Job job, const py::object& progress) {
  using Result = decltype(job(std::declval<Work&>()));
  auto result = std::make_shared<std::optional<Result>>();
  wait_for(
      std::make_shared<Work>(),
      [job = std::move(job), result](Work& work) { result->emplace(job(work)); }, true, progress);
  return std::move(**result);
}

}  // namespace gyrostat::python
