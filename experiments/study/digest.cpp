#include <gyrostat/experiments/study/digest.hpp>

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/experiments/study/design.hpp>
#include <gyrostat/experiments/study/scenario_reading.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;
using SortedJson = nlohmann::json;

struct Fnv {
  std::uint64_t hash = 0xcbf29ce484222325;
  void add(std::string_view bytes) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  std::string text() const { return fmt::format("{:016x}", hash); }
};

/// Puts the contents of the file that `object` names in the place of its name.
void resolve_file(SortedJson& object, const fs::path& folder) {
  if (!object.is_object() || !object.contains("file") || !object["file"].is_string()) return;
  object["file"] = file_digest(folder / object["file"].get<std::string>());
}

/// The cells that a grid stands for; a design is a function of what is written and stands for
/// itself.
std::vector<Json> without_grid(const Json& written, const std::string& path) {
  if (!written.contains("grid")) return {written};
  std::vector<Json> cells;
  for (auto& [cell, place] : cells_of(read_grid(written, path), written, path))
    cells.push_back(cell);
  return cells;
}

}  // namespace

std::string digest(std::string_view bytes) {
  Fnv fnv;
  fnv.add(bytes);
  return fnv.text();
}

std::string file_digest(const std::filesystem::path& path) {
  Fnv fnv;
  std::ifstream file(path, std::ios::binary);
  std::string block(1 << 20, '\0');
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    fnv.add({block.data(), static_cast<std::size_t>(file.gcount())});
  return fnv.text();
}

std::string study_digest(const Json& study, const std::string& path) {
  const auto folder = fs::path(path).parent_path();
  SortedJson canonical = {{"seed", study.value("seed", 1.0)}, {"cells", SortedJson::array()}};
  for (const auto& written : study.at("cells"))
    for (const auto& expanded : without_grid(written, path)) {
      auto cell = SortedJson::parse(expanded.dump());
      cell.erase("trials");
      cell.erase("stop");
      cell.erase("failure");
      if (cell.contains("pieces")) resolve_file(cell["pieces"], folder);
      for (const auto* source : scenario_sources)
        if (cell.contains("scenario") && cell["scenario"].contains(source))
          resolve_file(cell["scenario"][source], folder);
      canonical["cells"].push_back(std::move(cell));
    }
  return digest(canonical.dump());
}

}  // namespace gyrostat
