#include "experiments/json_object.hpp"

#include <filesystem>
#include <fstream>

namespace gyrostat {

Json read_json(const std::string& path) {
  if (!std::filesystem::exists(path)) throw InputError(path, "no such file");
  if (std::filesystem::is_directory(path)) throw InputError(path, "is a directory, not a file");
  std::ifstream file(path);
  if (!file) throw InputError(path, "cannot be read");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const auto begin = text.begin(), end = begin + static_cast<std::ptrdiff_t>(at);
    const auto line = 1 + std::count(begin, end, '\n');
    throw InputError(fmt::format("{}:{}", path, line),
                     text.empty() ? "the file is empty" : "not valid JSON here");
  }
}

}  // namespace gyrostat
