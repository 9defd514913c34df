#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat::cli {

void add_count(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("count", "how many trials of each cell are finished");
  auto folder = std::make_shared<std::string>();
  verb->add_option("folder", *folder, "folder of a run, as runs/<study>")->required();
  verb->footer("Examples:\n  gyrostat count runs/STUDY");
  verb->callback([folder, &console, &exit_code] {
    for (const auto& cell : Store::open(*folder).manifest().cells)
      console.out << fmt::format("{}: {}\n", cell.name, cell.finished);
    exit_code = complete;
  });
}

}  // namespace gyrostat::cli
