#include <gyrostat/recordings/binary/whole_file.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/input_file.hpp>

namespace gyrostat {

WholeFile::WholeFile(const FormatSource& source) {
  constexpr std::size_t most = std::size_t{1} << 30;
  const int file = source.file->is_plain() ? open(source.path.c_str(), O_RDONLY | O_CLOEXEC) : -1;
  struct stat status {};
  if (file >= 0 && fstat(file, &status) == 0 && status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (mapped != MAP_FAILED) {
      mapped_ = mapped;
      bytes_ = {static_cast<const char*>(mapped), size};
    }
  }
  if (file >= 0) close(file);
  if (mapped_) return;
  read_ = source.file->rest(most);
  bytes_ = read_;
}

WholeFile::~WholeFile() {
  if (mapped_) munmap(mapped_, bytes_.size());
}

}  // namespace gyrostat
