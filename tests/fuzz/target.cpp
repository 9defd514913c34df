#include <gyrostat/tests/fuzz/target.hpp>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/places.hpp>

namespace gyrostat::fuzz {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, std::string_view contents) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << contents;
}

}  // namespace

const std::map<std::string, Target>& targets() {
  static const auto all = [] {
    std::map<std::string, Target> made;
    append_targets(made);
    return made;
  }();
  return all;
}

Reader::Reader(const Target& target) : target_(target) {
  for (const auto& [file, contents] : target.beside) write(folder_.path() / file, contents);
}

std::string Reader::refusal(std::string_view document) const {
  const auto path = folder_.path() / target_.file;
  write(path, document);
  try {
    target_.read(path);
  } catch (const InputError& mistake) {
    if (*mistake.what() == '\0') throw std::logic_error("nothing is said");
    return mistake.what();
  }
  return "";
}

std::string project_file(const std::string& path) {
  std::ifstream file(fs::path(places::source()) / path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": is not in the tree");
  return {std::istreambuf_iterator<char>(file), {}};
}

void read_z(const fs::path& path, const std::string& format) {
  RecordingLayout layout;
  layout.preset = format;
  auto recording = read_recording(path, "z", layout);
  make_even(recording, path.string(), layout);
}

}  // namespace gyrostat::fuzz
