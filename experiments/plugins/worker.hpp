#pragma once

#include <chrono>
#include <future>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace gyrostat {

/// A process did not answer as it should: it ended, was silent for too long, or wrote what nobody
/// asked for. The message says which.
class WorkerFailure : public std::runtime_error {
 public:
  using runtime_error::runtime_error;
};

/// A process of its own that answers questions: from its standard input, on its standard output.
/// It goes with this object, and with the program, whatever ends that. Signals of the terminal do
/// not reach it.
///
/// Thread safety: it belongs to one thread at a time, whichever.
class Worker {
 public:
  /// Starts `command`, whose first word is looked for as a shell would. No answer may take longer
  /// than `limit_s`.
  Worker(const std::vector<std::string>& command, double limit_s);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// The line that it writes, and nothing behind it.
  std::string read_line();
  /// Sends all of the question and waits for all of the answer.
  void exchange(std::span<const double> question, std::span<double> answer);
  /// Ends it, with whatever it has started, without waiting for it to end by itself.
  void kill();

 private:
  using Clock = std::chrono::steady_clock;

  void start(const std::vector<std::string>& command);
  /// Waits until there is something to read or to write; throws where `until` comes first.
  void wait(bool to_read, bool to_write, Clock::time_point until);
  std::size_t read_some(char* to, std::size_t most);
  std::size_t write_some(const char* from, std::size_t most);
  void hear_complaints();
  /// Closes what it reads from; waits a moment until it has ended, then ends it.
  void end();
  [[noreturn]] void fail_as_it_ended();
  Clock::time_point limit() const;

  double limit_s_;
  int in_ = -1, out_ = -1, err_ = -1;  ///< its standard streams, from our side
  pid_t process_ = -1;
  std::thread keeper_;            ///< starts it and waits for its end
  std::future<int> wait_status_;  ///< as waitpid tells it
  std::string complaints_;        ///< the last that it wrote to standard error
};

}  // namespace gyrostat
