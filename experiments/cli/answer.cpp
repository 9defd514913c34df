#include <gyrostat/experiments/cli/answer.hpp>

#include <cstdlib>
#include <string_view>

#include <unistd.h>

namespace gyrostat::cli {
namespace {

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

bool may_be_bold() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDOUT_FILENO) != 0 && !is_set("NO_COLOR") && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

}  // namespace

void print_answer(Console& console, Format format, const std::string& answer) {
  if (answer.empty() || format != Format::text) return;
  const bool bold = may_be_bold();
  console.out << (bold ? "\x1b[1m" : "") << wrapped(answer) << (bold ? "\x1b[0m" : "") << '\n';
}

}  // namespace gyrostat::cli
