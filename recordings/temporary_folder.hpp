#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gyrostat/core/temporary_path.hpp>

namespace gyrostat {

/// A folder of its own among the temporary ones, gone at the end. Throws std::runtime_error where
/// none can be made.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "gyrostat_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be created");
    path_ = TemporaryPath(name);
  }
  const std::filesystem::path& path() const { return path_.path(); }

 private:
  TemporaryPath path_;
};

}  // namespace gyrostat
