#include <gyrostat/experiments/cli/phase_progress.hpp>

#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/cli/progress.hpp>

namespace gyrostat::cli {

PhaseProgress::PhaseProgress(std::ostream& out, bool is_terminal, std::string name)
    : out_(out), is_terminal_(is_terminal), name_(std::move(name)) {
  if (is_terminal_)
    thread_ =
        std::jthread([this](const std::stop_token& stop) { redraw(stop, [this] { draw(); }); });
}

PhaseProgress::~PhaseProgress() {
  if (!is_terminal_) return;
  thread_.request_stop();
  thread_.join();
  out_ << "\r\x1b[K" << std::flush;
}

void PhaseProgress::set(const std::string& phase, const std::string& detail, double share) {
  const std::lock_guard lock(mutex_);
  const bool is_new = phase != phase_;
  phase_ = phase;
  detail_ = detail;
  if (share > share_) {
    share_ = share;
    end_s_ = elapsed_s() / share;
  }
  if (!is_terminal_ && is_new)
    out_ << fmt::format("{}: {} ({:.0f} %{})\n", name_, phase_, 100.0 * share_, time_left())
         << std::flush;
}

double PhaseProgress::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::string PhaseProgress::time_left() const {
  constexpr double least_share = 0.02, minutes_from_s = 90.0;
  const double left_s = std::ceil(end_s_ - elapsed_s());
  if (share_ < least_share || share_ >= 1.0 || left_s <= 0.0) return "";
  return left_s < minutes_from_s ? fmt::format(", about {:.0f} s left", left_s)
                                 : fmt::format(", about {:.0f} min left", left_s / 60.0);
}

void PhaseProgress::draw() {
  const std::lock_guard lock(mutex_);
  out_ << fmt::format("\r{} {} {:.0f} %{}: {}{}{}\x1b[K", name_, progress_bar(share_),
                      100.0 * share_, time_left(), phase_, detail_.empty() ? "" : ", ", detail_)
       << std::flush;
}

}  // namespace gyrostat::cli
