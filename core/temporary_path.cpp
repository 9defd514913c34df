#include <gyrostat/core/temporary_path.hpp>

#include <mutex>
#include <set>
#include <system_error>
#include <utility>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

struct Known {
  std::mutex mutex;
  std::multiset<fs::path> paths;
};

/// Never destroyed, for threads may end after main.
Known& known() {
  static auto& all = *new Known;
  return all;
}

}  // namespace

TemporaryPath::TemporaryPath(fs::path path) : path_(std::move(path)) {
  const std::lock_guard lock(known().mutex);
  known().paths.insert(path_);
}

TemporaryPath::TemporaryPath(TemporaryPath&& other) noexcept
    : path_(std::exchange(other.path_, fs::path{})) {}

TemporaryPath& TemporaryPath::operator=(TemporaryPath&& other) noexcept {
  remove();
  path_ = std::exchange(other.path_, fs::path{});
  return *this;
}

void TemporaryPath::keep() {
  if (path_.empty()) return;
  const std::lock_guard lock(known().mutex);
  const auto own = known().paths.find(path_);
  if (own != known().paths.end()) known().paths.erase(own);
  path_.clear();
}

void TemporaryPath::remove() {
  if (path_.empty()) return;
  std::error_code absent;
  fs::remove_all(path_, absent);
  keep();
}

void remove_temporary_paths() {
  known().mutex.lock();  // for good: who would add one waits until the program has ended
  std::error_code absent;
  for (const auto& path : known().paths) {
    // Out of the way first: nobody can write into a folder that is no longer there.
    auto gone = path;
    gone += ".removed";
    fs::rename(path, gone, absent);
    fs::remove_all(absent ? path : gone, absent);
  }
}

}  // namespace gyrostat
