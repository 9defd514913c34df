#include <gyrostat/python/work.hpp>

#include <chrono>
#include <thread>
#include <vector>

#include <gyrostat/python/plugins.hpp>

namespace gyrostat::python {
namespace {

using namespace std::chrono_literals;

constexpr auto look_every = 50ms;
constexpr auto grace = 1s;  // for plug-ins in Python, once an end is asked for

std::vector<std::shared_ptr<Work>>& abandoned() {
  static std::vector<std::shared_ptr<Work>> jobs;  // guarded by the interpreter's lock
  return jobs;
}

}  // namespace

void Work::tell(std::string what, double share) {
  const std::lock_guard lock(mutex_);
  news_.emplace(std::move(what), share);
}

void wait_for(const std::shared_ptr<Work>& work, const std::function<void(Work&)>& job,
              bool heeds_stop, const py::object& progress) {
  std::thread thread([work, job] {
    try {
      job(*work);
    } catch (...) {
      work->thrown_ = std::current_exception();
    }
    const std::lock_guard lock(work->mutex_);
    work->done_ = true;
    work->ended_.notify_all();
  });
  std::optional<py::error_already_set> interrupted;
  std::chrono::steady_clock::time_point asked{};
  for (bool done = false; !done;) {
    std::optional<std::pair<std::string, double>> news;
    {
      const py::gil_scoped_release release;
      std::unique_lock lock(work->mutex_);
      done = work->ended_.wait_for(lock, look_every, [&] { return work->done_; });
      news.swap(work->news_);
    }
    if (interrupted) {
      if (std::chrono::steady_clock::now() - asked > grace) interrupt_plugins();
      continue;
    }
    try {
      if (news && !progress.is_none()) progress(news->first, news->second);
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (py::error_already_set& error) {
      interrupted.emplace(error);
      asked = std::chrono::steady_clock::now();
      work->stop = true;
      if (!heeds_stop && !done) {
        thread.detach();
        abandoned().push_back(work);
        throw std::move(*interrupted);
      }
    }
  }
  {
    const py::gil_scoped_release release;
    thread.join();
  }
  if (interrupted) throw std::move(*interrupted);
  if (work->thrown_) std::rethrow_exception(work->thrown_);
}

void wait_for_abandoned() {
  const auto jobs = std::move(abandoned());
  const py::gil_scoped_release release;
  for (const auto& work : jobs) {
    std::unique_lock lock(work->mutex_);
    work->ended_.wait(lock, [&] { return work->done_; });
  }
}

}  // namespace gyrostat::python
