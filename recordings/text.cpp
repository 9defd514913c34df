#include <gyrostat/recordings/text.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/input_file.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  InputFile file(path);
  std::string text = file.rest(most_bytes);
  if (text.empty())
    throw InputError(file.place(), "is empty; allowed: a header and at least one sample");
  if (const auto zero = text.find('\0'); zero != std::string::npos)
    throw InputError(file.place(), fmt::format("is not text: byte {} is zero", zero));
  return text;
}

std::string printable(std::string_view text) {
  std::string ascii(text);
  std::replace_if(
      ascii.begin(), ascii.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return ascii;
}

}  // namespace gyrostat
