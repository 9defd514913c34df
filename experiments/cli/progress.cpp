#include <gyrostat/experiments/cli/progress.hpp>

#include <condition_variable>

#include <fmt/format.h>

namespace gyrostat::cli {

std::string progress_bar(double share) {
  constexpr std::size_t width = 30;
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
  return fmt::format("[{:#<{}}{:.<{}}]", "", filled, "", width - filled);
}

void redraw(const std::stop_token& stop, const std::function<void()>& draw) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    draw();
    wake.wait_for(lock, stop, std::chrono::milliseconds(200), [] { return false; });
  }
}

Progress::Progress(std::ostream& out, bool is_terminal, std::string name, std::size_t total)
    : out_(out),
      is_terminal_(is_terminal),
      name_(std::move(name)),
      total_(total),
      thread_([this](const std::stop_token& stop) {
        redraw(stop, [this] { draw(); });
        draw();
      }) {}

Progress::~Progress() {
  thread_.request_stop();
  thread_.join();
  if (is_terminal_) out_ << '\n' << std::flush;
}

void Progress::set(std::size_t finished) { finished_.store(finished, std::memory_order_relaxed); }

void Progress::set(std::size_t finished, std::string line) {
  const std::lock_guard lock(mutex_);
  line_ = std::move(line);
  set(finished);
}

void Progress::draw() {
  std::unique_lock lock(mutex_);
  const std::size_t finished = finished_.load(std::memory_order_relaxed);
  std::string line = line_;
  lock.unlock();
  if (line.empty()) {
    const double elapsed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double rate = elapsed > 0.0 ? static_cast<double>(finished) / elapsed : 0.0;
    const double left = rate > 0.0 ? static_cast<double>(total_ - finished) / rate : 0.0;
    line =
        fmt::format("{}/{} trials, {:.0f} trials/s, {:.0f} s left", finished, total_, rate, left);
  }
  if (is_terminal_) {
    const double share = static_cast<double>(finished) / static_cast<double>(total_);
    out_ << fmt::format("\r{} {} {}\x1b[K", name_, progress_bar(share), line) << std::flush;
    return;
  }
  const std::size_t tenths = 10 * finished / total_;
  if (tenths == tenths_) return;
  tenths_ = tenths;
  out_ << name_ << ": " << line << '\n' << std::flush;
}

}  // namespace gyrostat::cli
