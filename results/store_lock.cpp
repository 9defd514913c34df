#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <gyrostat/results/store.hpp>

namespace gyrostat {

Store::Lock::Lock(const std::filesystem::path& folder) {
  const auto path = folder / "store.lock";
  file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0)
    throw StoreError(fmt::format("{}: cannot be written to: {}", folder.string(),
                                 std::generic_category().message(errno)));
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    ::close(file);
    throw StoreError(
        fmt::format("{}: another run is writing here; wait for it, or name another folder "
                    "with --out",
                    folder.string()));
  }
}

Store::Lock::~Lock() {
  if (file >= 0) ::close(file);
}

}  // namespace gyrostat
