// sensitivity_coverage [repeats] [seed]: the coverage of sensitivity intervals, as tables.json of a
// page, and as Markdown on standard error.
#include <gyrostat/experiments/coverage/sensitivity_coverage.hpp>

#include <cstdlib>
#include <iostream>

#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/results/render/render.hpp>

int main(int argc, char** argv) {
  using namespace gyrostat;
  const auto number = [&](int i, unsigned long fallback) {
    return i < argc ? std::strtoul(argv[i], nullptr, 10) : fallback;
  };
  const auto tables =
      sensitivity_coverage(static_cast<std::uint32_t>(number(1, 2000)), number(2, 1));
  for (const auto& [name, text] : page_files(tables))
    if (name == "tables.json") std::cout << text;
  for (const auto& named : tables) std::cerr << render({&named.table, 1}, Format::markdown);
}
