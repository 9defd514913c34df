#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/recordings/temporary_folder.hpp>

namespace gyrostat::fuzz {

/// Something that reads what others wrote. It may throw InputError; any other end is a fault.
struct Target {
  std::string_view file;                        ///< what the document is called in its folder
  std::vector<std::string> seeds;               ///< documents that are read without an error
  void (*read)(const std::filesystem::path&);   ///< the document, by its path
  std::map<std::string, std::string> beside{};  ///< other files of its folder that it may name
};

/// Every target, one from each file of targets/, by name.
///
/// A file <id>.cpp defines `Target target_<id>()`.
const std::map<std::string, Target>& targets();
void append_targets(std::map<std::string, Target>& to);

/// Puts documents where a target looks for them, and has them read.
class Reader {
 public:
  explicit Reader(const Target& target);

  /// What was said against the document; empty where it was read. Throws whatever the target throws
  /// that is no InputError, and std::logic_error where nothing is said.
  std::string refusal(std::string_view document) const;

 private:
  const Target& target_;
  TemporaryFolder folder_;
};

/// For files of targets/: a file of the project's tree.
std::string project_file(const std::string& path);

}  // namespace gyrostat::fuzz
