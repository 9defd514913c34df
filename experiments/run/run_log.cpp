#include <gyrostat/experiments/run/run_log.hpp>

#include <nlohmann/json.hpp>

#include <gyrostat/experiments/run/build.hpp>

namespace gyrostat {

RunLog::RunLog(const std::filesystem::path& path) : file_(path, std::ios::app) {}

void RunLog::write(const std::string& event, const Json& details) {
  Json line = {{"time", utc_now()}, {"event", event}};
  line.update(details);
  const std::lock_guard lock(mutex_);
  file_ << line.dump() + '\n' << std::flush;
}

}  // namespace gyrostat
