#pragma once

#include <deque>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include <gyrostat/core/registry.hpp>
#include <gyrostat/recordings/column_table.hpp>

namespace gyrostat {

class InputFile;
struct CsvHeader;

/// A file from outside as formats see it before it is read.
struct FormatHead {
  std::filesystem::path path;
  std::string_view bytes;             ///< up to 64 KiB from its front; none of a folder
  const CsvHeader* header = nullptr;  ///< of a text, once it is known to be one

  bool starts_with(std::string_view magic) const { return bytes.starts_with(magic); }
  /// Whether a text has this column.
  bool has(std::string_view column) const;
  std::size_t columns() const;
  bool has_all(std::initializer_list<std::string_view> columns) const;
};

/// What is to be read.
struct FormatSource {
  std::filesystem::path path;
  std::string place;
  InputFile* file = nullptr;  ///< nothing was read of it yet; none of a folder
  std::string topic;          ///< where a log holds several gyros
};

/// A format of recordings: how it is known, and what its columns mean. A format of text says which
/// columns are which (`layout`), any other reads them (`read`).
struct RecordingFormat {
  std::string_view title;
  bool (*recognises)(const FormatHead&) = nullptr;
  RecordingLayout (*layout)(const FormatHead&) = nullptr;
  ColumnTable (*read)(const FormatSource&) = nullptr;
};

/// The same under the name of the file that it stands in: the preset.
struct FormatType : RecordingFormat {
  static constexpr std::string_view kind = "preset";
  static void describe_all(std::deque<FormatType>& to);

  std::string id;
};

inline Registry<FormatType>& format_types() { return Registry<FormatType>::all(); }

/// The first format that recognises the file; none where it is none of them.
const FormatType* format_of(const FormatHead& head);

/// A format that is known and not read: its name and how to turn it into one that is.
struct UnreadableFormat {
  std::string_view name, remedy;
};
std::optional<UnreadableFormat> unreadable_format(const FormatHead& head);

}  // namespace gyrostat
