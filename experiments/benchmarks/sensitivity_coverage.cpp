// sensitivity_coverage [repeats] [seed]: the coverage of sensitivity intervals as JSON, and as
// Markdown on standard error.
#include "experiments/sensitivity_coverage.hpp"

#include <cstdlib>
#include <iostream>

#include "results/render/render.hpp"

int main(int argc, char** argv) {
  using namespace gyrostat;
  const auto number = [&](int i, unsigned long fallback) {
    return i < argc ? std::strtoul(argv[i], nullptr, 10) : fallback;
  };
  const auto table =
      sensitivity_coverage(static_cast<std::uint32_t>(number(1, 2000)), number(2, 1));
  std::cout << render({&table, 1}, Format::json);
  std::cerr << render({&table, 1}, Format::markdown);
}
