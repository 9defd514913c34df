#include <gyrostat/results/pictures/lettering.hpp>

#include <algorithm>

namespace gyrostat::render_detail {
namespace {

/// Whether a letter of UTF-8 begins here.
bool begins(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

/// Where the letter of that number begins.
std::size_t place_of(const std::string& text, std::size_t number) {
  std::size_t at = 0;
  for (; at < text.size(); ++at)
    if (begins(text[at]) && number-- == 0) break;
  return at;
}

}  // namespace

double length_of(const std::string& text) {
  return letter * static_cast<double>(std::count_if(text.begin(), text.end(), begins));
}

std::string shortened(const std::string& text, double room) {
  if (length_of(text) <= room) return text;
  const auto letters = static_cast<std::size_t>(length_of(text) / letter + 0.5);
  const auto kept = static_cast<std::size_t>(std::max(room / letter - 1.0, 4.0));
  const std::size_t tail = kept / 3;
  if (letters <= kept + 1) return text;
  return text.substr(0, place_of(text, kept - tail)) + "…" +
         text.substr(place_of(text, letters - tail));
}

std::vector<std::string> lines_within(const std::string& text, double room) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find(' ', at), text.size());
    const auto word = text.substr(at, end - at);
    if (!lines.empty() && length_of(lines.back() + " " + word) <= room)
      lines.back() += " " + word;
    else
      lines.push_back(word);
    at = end + 1;
  }
  return lines;
}

}  // namespace gyrostat::render_detail
