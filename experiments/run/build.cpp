#include <gyrostat/experiments/run/build.hpp>

#include <chrono>
#include <fstream>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <gyrostat/experiments/run/build_info.hpp>

namespace gyrostat {

Build this_build() {
  return {GYROSTAT_VERSION " " GYROSTAT_COMMIT, GYROSTAT_COMPILER, GYROSTAT_FLAGS};
}

std::string this_machine() {
  std::string processor = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      processor = line.substr(line.find(':') + 2);
      break;
    }
  utsname system{};
  uname(&system);
  return fmt::format("{}, {} threads, {}, {} {}", processor, std::thread::hardware_concurrency(),
                     system.nodename, system.sysname, system.release);
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace gyrostat
