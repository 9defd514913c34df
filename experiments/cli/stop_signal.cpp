#include <gyrostat/experiments/cli/stop_signal.hpp>

#include <cerrno>
#include <ctime>
#include <string_view>
#include <thread>

#include <semaphore.h>
#include <signal.h>
#include <unistd.h>

#include <gyrostat/core/temporary_path.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>

namespace gyrostat::cli {
namespace {

sem_t arrived;  // the one thing that a handler may do and a thread can wait for
std::atomic<int> first_signal{0};
std::atomic<bool> stop_requested{false};
std::atomic<const char*> last_words{nullptr};  ///< of a verb that ends in good order

void on_signal(int signal) {
  const int before = errno;
  int none = 0;
  first_signal.compare_exchange_strong(none, signal);
  sem_post(&arrived);
  errno = before;
}

void wait_for_signal() {
  while (sem_wait(&arrived) != 0) {
  }
}

/// Until `grace_s` are over or another signal comes.
void give_grace() {
  timespec end{};
  clock_gettime(CLOCK_REALTIME, &end);
  constexpr long second_ns = 1'000'000'000;
  end.tv_nsec += static_cast<long>(StopSignal::grace_s * 1e9);
  end.tv_sec += end.tv_nsec / second_ns;
  end.tv_nsec %= second_ns;
  while (sem_timedwait(&arrived, &end) != 0 && errno == EINTR) {
  }
}

void say(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody is left to be told
}

[[noreturn]] void end_program() {
  remove_temporary_paths();
  if (::isatty(STDERR_FILENO) != 0) say("\r\x1b[K");
  const char* words = last_words;
  if (words == nullptr) _exit(128 + first_signal);
  say(words);
  _exit(stopped);
}

void serve() {
  wait_for_signal();
  if (last_words != nullptr) {
    stop_requested = true;
    give_grace();
  }
  end_program();
}

}  // namespace

StopSignal::StopSignal() {
  sem_init(&arrived, 0, 0);
  std::thread(serve).detach();
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& StopSignal::orderly(Done done) {
  last_words = done == Done::is_kept
                   ? "gyrostat: stopped early: what is finished is kept, and the same command goes "
                     "on from it\n"
                   : "gyrostat: stopped early: nothing was written\n";
  return stop_requested;
}

}  // namespace gyrostat::cli
