#pragma once

#include <filesystem>

namespace gyrostat {

/// A file or folder that goes with this object, or with the program where `remove_temporary_paths`
/// is what ends it.
///
/// Thread safety: any number of threads may have their own.
class TemporaryPath {
 public:
  TemporaryPath() = default;
  explicit TemporaryPath(std::filesystem::path path);
  ~TemporaryPath() { remove(); }
  TemporaryPath(TemporaryPath&& other) noexcept;
  TemporaryPath& operator=(TemporaryPath&& other) noexcept;

  const std::filesystem::path& path() const { return path_; }
  bool empty() const { return path_.empty(); }
  /// It has another name now, and stays.
  void keep();

 private:
  void remove();

  std::filesystem::path path_;
};

/// Removes all there are, for an end that runs no destructors. None can be made afterwards.
void remove_temporary_paths();

}  // namespace gyrostat
