#include <gyrostat/core/words.hpp>

#include <array>
#include <cstdio>

#include <gyrostat/core/fields.hpp>

namespace gyrostat {
namespace {

/// Every "e+08" as "e8".
std::string bare_exponents(std::string text) {
  for (std::size_t at = 0; (at = text.find_first_of("+-", at)) != std::string::npos; ++at) {
    if (at == 0 || text[at - 1] != 'e') continue;
    std::size_t digits = at + (text[at] == '-');
    text.erase(digits, text.find_first_not_of("+0", digits) - digits);
  }
  return text;
}

}  // namespace

std::string counted(std::uint64_t count, std::string_view noun) {
  return std::to_string(count).append(1, ' ').append(noun).append(count == 1 ? "" : "s");
}

std::string chance_in_words(double p) {
  if (p < least_chance) return "< 1e-6";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "= %.2g", p);
  return bare_exponents(text.data());
}

std::string values_in_words(const Range& range, std::string_view unit) {
  auto text = bare_exponents(range.to_string());
  if (!unit.empty() && unit != "1")
    text.insert(text.find_first_of("])") + 1, std::string(1, ' ').append(unit));
  return text;
}

}  // namespace gyrostat
