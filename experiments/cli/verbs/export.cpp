#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* export_examples = R"(Examples:
  gyrostat export runs/STUDY > outcomes.csv
  gyrostat export runs/STUDY --out outcomes.csv.gz)";

struct ExportArguments {
  std::string folder, out;
};

int run(const ExportArguments& arguments, Console& console) {
  const Store store = Store::open(arguments.folder);
  if (arguments.out.empty()) {
    export_outcomes(store, [&](std::string_view text) {
      if (!console.out.write(text.data(), static_cast<std::streamsize>(text.size())))
        throw std::runtime_error("the output cannot be written");
    });
  } else if (arguments.out.ends_with(".gz")) {
    write_outcomes(arguments.out, store);
  } else {
    AtomicFile file(arguments.out);
    export_outcomes(store, [&](std::string_view text) { file.write(text); });
    file.commit();
  }
  return complete;
}

}  // namespace

void add_export(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "export", "the outcomes of a study's finished trials as CSV, by cell, trial and filter");
  auto arguments = std::make_shared<ExportArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--out", arguments->out, "CSV or CSV.gz to write (default: to the terminal)");
  verb->footer(export_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
