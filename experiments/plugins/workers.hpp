#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gyrostat/experiments/plugins/worker.hpp>

namespace gyrostat {

/// As many processes of one command as there are threads that ask at once. Each describes itself in
/// its first line; one that fails is given up, and the next question has a new one.
///
/// Thread safety: any number of threads may call `with_one` at once.
class Workers {
 public:
  /// `code` tells the code that the command runs from another: no process is started after it has
  /// changed. Without a `description`, one is started to hear it; throws WorkerFailure where that
  /// fails.
  Workers(std::vector<std::string> command, double limit_s, std::function<std::string()> code,
          std::string description = "");

  const std::string& description() const { return description_; }
  /// Tells what is run from anything else under the same name.
  std::string code() const;

  /// Calls `ask` with a process of which nobody else asks anything meanwhile. What it throws passes
  /// through.
  void with_one(const std::function<void(Worker&)>& ask);
  /// The same with one that was never asked anything.
  void with_fresh_one(const std::function<void(Worker&)>& ask);

 private:
  std::unique_ptr<Worker> started() const;

  std::vector<std::string> command_;
  double limit_s_;
  std::function<std::string()> code_now_;
  std::string code_, description_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace gyrostat
