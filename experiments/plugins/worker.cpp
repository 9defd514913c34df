#include <gyrostat/experiments/plugins/worker.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gyrostat {
namespace {

constexpr std::size_t most_complaints = 4096, most_of_a_line = 1 << 20;
constexpr int pipe_bytes = 1 << 18;  // a block of samples at once
constexpr auto grace = std::chrono::seconds(1);

struct Pipe {
  int read = -1, write = -1;

  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw WorkerFailure(fmt::format("cannot be started: {}", std::strerror(errno)));
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    for (const int end : {read, write})
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

/// Our end of a pipe, which waits for nobody.
int kept(int& end) {
  ::fcntl(end, F_SETFL, O_NONBLOCK);
  (void)::fcntl(end, F_SETPIPE_SZ, pipe_bytes);  // which may be refused
  return std::exchange(end, -1);
}

/// In the process that was forked off, where only system calls are allowed.
[[noreturn]] void become(char* const* words, const Pipe& in, const Pipe& out, const Pipe& err) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // sent when the keeper's thread ends, with all others
  ::dup2(in.read, STDIN_FILENO);
  ::dup2(out.write, STDOUT_FILENO);
  ::dup2(err.write, STDERR_FILENO);
  for (const int ignored : {SIGPIPE, SIGXFSZ}) ::signal(ignored, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::execvp(words[0], words);
  const char* reason = ::strerrordesc_np(errno);
  (void)!::write(STDERR_FILENO, reason, std::strlen(reason));
  ::_exit(127);
}

/// While it lives, writing to who has gone is an error and no signal.
class WithoutBrokenPipes {
 public:
  WithoutBrokenPipes() {
    sigemptyset(&broken_);
    sigaddset(&broken_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &broken_, &before_);
  }
  ~WithoutBrokenPipes() {
    const timespec now{};
    if (was_broken && sigismember(&before_, SIGPIPE) == 0)
      while (sigtimedwait(&broken_, nullptr, &now) < 0 && errno == EINTR) {
      }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutBrokenPipes(const WithoutBrokenPipes&) = delete;
  WithoutBrokenPipes& operator=(const WithoutBrokenPipes&) = delete;

  bool was_broken = false;

 private:
  sigset_t broken_{}, before_{};
};

/// The last line that has anything in it, printable.
std::string last_line(std::string text) {
  const auto end = text.find_last_not_of("\r\n\t ");
  if (end == std::string::npos) return "";
  text.erase(end + 1);
  const auto begin = text.find_last_of('\n');
  if (begin != std::string::npos) text.erase(0, begin + 1);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

}  // namespace

Worker::Worker(const std::vector<std::string>& command, double limit_s) : limit_s_(limit_s) {
  start(command);
}

void Worker::start(const std::vector<std::string>& command) {
  Pipe in, out, err;
  std::vector<char*> words;
  for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  std::promise<pid_t> started;
  std::promise<int> ended;
  auto process = started.get_future();
  wait_status_ = ended.get_future();
  keeper_ = std::thread([&, started = std::move(started), ended = std::move(ended)]() mutable {
    const pid_t pid = ::fork();
    if (pid == 0) become(words.data(), in, out, err);
    started.set_value(pid);  // from here on what it knows by reference is gone
    if (pid < 0) return ended.set_value(0);
    siginfo_t info{};
    while (::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT) != 0 &&
           errno == EINTR) {
    }
    ended.set_value(info.si_code == CLD_EXITED ? info.si_status : -info.si_status);
  });
  process_ = process.get();
  if (process_ < 0) {
    keeper_.join();
    throw WorkerFailure("cannot be started: no process is to be had");
  }
  in_ = kept(in.write);
  out_ = kept(out.read);
  err_ = kept(err.read);
}

Worker::~Worker() {
  end();
  ::close(out_);
  if (err_ >= 0) ::close(err_);
}

void Worker::end() {
  if (in_ < 0) return;
  ::close(std::exchange(in_, -1));
  if (wait_status_.wait_for(grace) != std::future_status::ready) kill();
  wait_status_.wait();
  keeper_.join();
  ::waitpid(std::exchange(process_, -1), nullptr, 0);
}

void Worker::kill() {
  if (process_ < 0) return;
  ::kill(-process_, SIGKILL);
  ::kill(process_, SIGKILL);
}

void Worker::fail_as_it_ended() {
  const bool by_itself = wait_status_.wait_for(grace) == std::future_status::ready;
  end();
  if (err_ >= 0) hear_complaints();
  const int status = wait_status_.get();
  const auto complaint = last_line(complaints_);
  auto what = !by_itself   ? std::string("closed its standard output")
              : status < 0 ? fmt::format("ended by signal {} ({})", -status, ::strsignal(-status))
                           : fmt::format("ended with exit code {}", status);
  throw WorkerFailure(complaint.empty() ? what : what + ": " + complaint);
}

Worker::Clock::time_point Worker::limit() const {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s_));
}

void Worker::wait(bool to_read, bool to_write, Clock::time_point until) {
  while (true) {
    std::array<pollfd, 3> streams = {pollfd{to_read ? out_ : -1, POLLIN, 0},
                                     pollfd{to_write ? in_ : -1, POLLOUT, 0},
                                     pollfd{err_, POLLIN, 0}};
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count() + 1;
    const int ready =
        ::poll(streams.data(), streams.size(), static_cast<int>(std::clamp<long>(left, 0, 1000)));
    if (ready > 0 && streams[2].revents != 0) hear_complaints();
    if (ready > 0 && (streams[0].revents != 0 || streams[1].revents != 0)) return;
    if (Clock::now() >= until) {
      ::kill(-process_, SIGKILL);
      throw WorkerFailure(fmt::format("gave no answer for {:g} s", limit_s_));
    }
  }
}

void Worker::hear_complaints() {
  std::array<char, 4096> block{};
  while (true) {
    const auto count = ::read(err_, block.data(), block.size());
    if (count == 0) ::close(std::exchange(err_, -1));
    if (count <= 0) return;
    complaints_.append(block.data(), static_cast<std::size_t>(count));
    if (complaints_.size() > most_complaints)
      complaints_.erase(0, complaints_.size() - most_complaints);
  }
}

std::size_t Worker::read_some(char* to, std::size_t most) {
  const auto count = ::read(out_, to, most);
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) fail_as_it_ended();
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

std::size_t Worker::write_some(const char* from, std::size_t most) {
  WithoutBrokenPipes guard;
  const auto count = ::write(in_, from, most);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return 0;
  guard.was_broken = errno == EPIPE;
  fail_as_it_ended();
}

std::string Worker::read_line() {
  std::string line;
  std::array<char, 4096> block{};
  const auto until = limit();
  while (true) {
    wait(true, false, until);
    line.append(block.data(), read_some(block.data(), block.size()));
    const auto end = line.find('\n');
    if (end != std::string::npos && end + 1 < line.size())
      throw WorkerFailure("writes more than one line before it is asked anything");
    if (end != std::string::npos) return line.substr(0, end);
    if (line.size() > most_of_a_line) throw WorkerFailure("does not describe itself in one line");
  }
}

void Worker::exchange(std::span<const double> question, std::span<double> answer) {
  auto asked = std::as_bytes(question);
  auto answered = std::as_writable_bytes(answer);
  const auto until = limit();
  while (!asked.empty() || !answered.empty()) {
    wait(!answered.empty(), !asked.empty(), until);
    if (!answered.empty())
      answered =
          answered.subspan(read_some(reinterpret_cast<char*>(answered.data()), answered.size()));
    if (!asked.empty())
      asked = asked.subspan(write_some(reinterpret_cast<const char*>(asked.data()), asked.size()));
  }
}

}  // namespace gyrostat
