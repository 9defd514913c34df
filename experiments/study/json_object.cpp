#include <gyrostat/experiments/study/json_object.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>

namespace gyrostat {

namespace {

/// Far beyond what any file of ours needs, and far below what fills a memory or an hour.
constexpr std::size_t most_depth = 64, most_keys = 10'000;
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 28;

/// "file:line:column" of a byte.
std::string line_place(const std::string& path, const std::string& text, std::size_t at) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size()));
  const auto line = std::find(std::reverse_iterator(end), text.rend(), '\n').base();
  return fmt::format("{}:{}:{}", path, 1 + std::count(text.begin(), end, '\n'), end - line + 1);
}

/// What the JSON library says after its "[…] parse error at line 1, column 2: ".
std::string reason_of(const std::string& message) {
  const auto column = message.find("column ");
  const auto reason = column == std::string::npos ? column : message.find(": ", column);
  auto text = reason == std::string::npos ? message : message.substr(reason + 2);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == 127; }, ' ');
  return text;
}

/// The token that a number error of the JSON library quotes.
std::string quoted_token(const std::string& message) {
  const auto end = message.rfind('\''), begin = message.rfind('\'', end - 1);
  return end == std::string::npos || begin == std::string::npos
             ? std::string{}
             : message.substr(begin + 1, end - begin - 1);
}

/// Watches the parser for keys that stand twice in one object, which JSON leaves undefined.
class UniqueKeys {
 public:
  UniqueKeys(std::string path, Mistakes& mistakes) : path_(std::move(path)), mistakes_(mistakes) {}

  bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start)
      open(event == Event::array_start);
    if (event == Event::key) {
      open_.back().key = parsed.get<std::string>();
      if (open_.back().keys.size() == most_keys)
        throw InputError(path_,
                         fmt::format("{}: an object of more than {} keys", place(), most_keys));
      if (!open_.back().keys.insert(open_.back().key).second)
        mistakes_.note(fmt::format("{}: {}: the key stands twice", path_, place()));
    }
    if (event == Event::object_end || event == Event::array_end) open_.pop_back();
    const bool value_ends =
        event == Event::object_end || event == Event::array_end || event == Event::value;
    if (value_ends && !open_.empty()) ++open_.back().index;
    return true;
  }

 private:
  void open(bool is_array) {
    if (open_.size() == most_depth)
      throw InputError(path_,
                       fmt::format("lists and objects are nested more than {} deep", most_depth));
    open_.push_back({.is_array = is_array, .keys = {}, .key = ""});
  }

  struct Level {
    bool is_array;
    std::set<std::string> keys;
    std::string key;
    std::size_t index = 0;
  };

  /// As JsonObject has it: cells[0].scenario.duration_s.
  std::string place() const {
    std::string text;
    for (const auto& level : open_)
      text += level.is_array ? fmt::format("[{}]", level.index)
                             : fmt::format("{}{}", text.empty() ? "" : ".", level.key);
    return text;
  }

  std::string path_;
  Mistakes& mistakes_;
  std::vector<Level> open_;
};

}  // namespace

Json read_json(const std::string& path, Mistakes* mistakes) {
  if (!std::filesystem::exists(path)) throw InputError(path, "no such file");
  if (std::filesystem::is_directory(path)) throw InputError(path, "is a directory, not a file");
  std::error_code unknown;
  if (const auto size = std::filesystem::file_size(path, unknown); !unknown && size > most_bytes)
    throw InputError(path, fmt::format("{} bytes; allowed: up to {}", size, most_bytes));
  std::ifstream file(path);
  if (!file) throw InputError(path, "cannot be read");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  try {
    Mistakes twice;
    Json json = Json::parse(text, UniqueKeys(path, mistakes ? *mistakes : twice));
    twice.raise();
    return json;
  } catch (const Json::parse_error& error) {
    throw InputError(
        line_place(path, text, error.byte > 0 ? error.byte - 1 : 0),
        text.empty() ? "the file is empty" : "not valid JSON: " + reason_of(error.what()));
  } catch (const Json::out_of_range& error) {
    const auto token = quoted_token(error.what());
    throw InputError(line_place(path, text, text.find(token)),
                     fmt::format("{} is beyond what a number can hold", token));
  }
}

}  // namespace gyrostat
