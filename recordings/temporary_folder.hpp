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
    const std::string place_of_letters(6, 'X');  // mkdtemp's own
    std::string name =
        (std::filesystem::temp_directory_path() / ("gyrostat_" + place_of_letters)).string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be created");
    path_ = TemporaryPath(name);
  }
  const std::filesystem::path& path() const { return path_.path(); }

 private:
  TemporaryPath path_;
};

}  // namespace gyrostat
