#include <gyrostat/experiments/study/json_object.hpp>

#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>

namespace gyrostat {

namespace {

std::string line_place(const std::string& path, const std::string& text, std::size_t at) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size()));
  return fmt::format("{}:{}", path, 1 + std::count(text.begin(), end, '\n'));
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
      open_.push_back({.is_array = event == Event::array_start, .keys = {}, .key = ""});
    if (event == Event::key) {
      open_.back().key = parsed.get<std::string>();
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
  std::ifstream file(path);
  if (!file) throw InputError(path, "cannot be read");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  try {
    Mistakes twice;
    Json json = Json::parse(text, UniqueKeys(path, mistakes ? *mistakes : twice));
    twice.raise();
    return json;
  } catch (const Json::parse_error& error) {
    throw InputError(line_place(path, text, error.byte > 0 ? error.byte - 1 : 0),
                     text.empty() ? "the file is empty" : "not valid JSON here");
  } catch (const Json::out_of_range& error) {
    const auto token = quoted_token(error.what());
    throw InputError(line_place(path, text, text.find(token)),
                     fmt::format("{} is beyond what a number can hold", token));
  }
}

}  // namespace gyrostat
