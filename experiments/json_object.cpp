#include "experiments/json_object.hpp"

#include <filesystem>
#include <fstream>
#include <set>

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
  explicit UniqueKeys(std::string path) : path_(std::move(path)) {}

  bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event == Json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second)
      throw InputError(path_, "the key '" + parsed.get<std::string>() + "' stands twice");
    return true;
  }

 private:
  std::string path_;
  std::vector<std::set<std::string>> open_;
};

}  // namespace

Json read_json(const std::string& path) {
  if (!std::filesystem::exists(path)) throw InputError(path, "no such file");
  if (std::filesystem::is_directory(path)) throw InputError(path, "is a directory, not a file");
  std::ifstream file(path);
  if (!file) throw InputError(path, "cannot be read");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  try {
    return Json::parse(text, UniqueKeys(path));
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
