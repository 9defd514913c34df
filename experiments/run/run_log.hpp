#pragma once

#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>

#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

/// A log of JSON lines: {"time": …, "event": …, …}, appended to, each line on its way to the disk
/// as it is written. A log that cannot be written harms no run.
class RunLog {
 public:
  explicit RunLog(const std::filesystem::path& path);
  void write(const std::string& event, const Json& details);

 private:
  std::mutex mutex_;
  std::ofstream file_;
};

}  // namespace gyrostat
