#pragma once

#include <string>
#include <string_view>

#include <gyrostat/recordings/format_type.hpp>

namespace gyrostat {

/// All bytes of a source: mapped where it is a plain file, whatever its length; read where it is
/// packed or a pipe, up to 1 GiB.
class WholeFile {
 public:
  explicit WholeFile(const FormatSource& source);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  std::string_view bytes() const { return bytes_; }

 private:
  std::string read_;
  std::string_view bytes_;
  void* mapped_ = nullptr;
};

}  // namespace gyrostat
