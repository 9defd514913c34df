#include <fmt/format.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* repair_examples = R"(Examples:
  gyrostat repair runs/STUDY     keeps every trial that is sound; gyrostat run STUDY.json makes the others again
  gyrostat repair runs/STUDY --study STUDY.json     where the store's own record of its study is damaged)";

struct RepairArguments {
  std::string folder, study;
};

int run(const RepairArguments& arguments, Console& console) {
  std::optional<Manifest> named;
  if (!arguments.study.empty()) named = manifest_of(read_study(arguments.study));
  const auto result = Store::repair(arguments.folder, named);
  if (result.is_sound()) {
    console.log << fmt::format("{}: sound, {}\n", arguments.folder, counted(result.kept, "trial"));
    return complete;
  }
  console.log << fmt::format("{}: {} kept, {} dropped{}; the damaged store is {}\n",
                             arguments.folder, counted(result.kept, "trial"), result.dropped,
                             result.log_was_damaged ? ", more of a damaged log are lost" : "",
                             result.aside->string())
              << "gyrostat run with the same study makes again what is missing\n";
  return stopped;
}

}  // namespace

void add_repair(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "repair", "keep every sound trial of a damaged store, so that the others are run again");
  auto arguments = std::make_shared<RepairArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--study", arguments->study,
                   "study file whose outcomes these are, where the store no longer says so");
  verb->footer(repair_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
