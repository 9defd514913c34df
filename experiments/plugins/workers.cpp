#include <gyrostat/experiments/plugins/workers.hpp>

#include <utility>

#include <gyrostat/experiments/study/digest.hpp>

namespace gyrostat {

Workers::Workers(std::vector<std::string> command, double limit_s,
                 std::function<std::string()> code, std::string description)
    : command_(std::move(command)),
      limit_s_(limit_s),
      code_now_(std::move(code)),
      code_(code_now_()),
      description_(std::move(description)) {
  if (!description_.empty()) return;
  auto first = std::make_unique<Worker>(command_, limit_s_);
  description_ = first->read_line();
  idle_.push_back(std::move(first));
}

std::string Workers::code() const { return digest(code_ + description_); }

std::unique_ptr<Worker> Workers::started() const {
  if (code_now_() != code_) throw WorkerFailure("its file was changed since it was first read");
  auto worker = std::make_unique<Worker>(command_, limit_s_);
  if (worker->read_line() != description_)
    throw WorkerFailure("describes itself otherwise than before");
  return worker;
}

void Workers::with_one(const std::function<void(Worker&)>& ask) {
  std::unique_ptr<Worker> worker;
  {
    const std::scoped_lock lock(mutex_);
    if (!idle_.empty()) {
      worker = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!worker) worker = started();
  try {
    ask(*worker);
  } catch (...) {
    worker->kill();  // what it would say next belongs to no question
    throw;
  }
  const std::scoped_lock lock(mutex_);
  idle_.push_back(std::move(worker));
}

void Workers::with_fresh_one(const std::function<void(Worker&)>& ask) { ask(*started()); }

}  // namespace gyrostat
