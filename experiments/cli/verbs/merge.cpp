#include <fmt/format.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* merge_examples = R"(Examples:
  gyrostat merge runs/STUDY runs/STUDY/shard_*     the outcomes of all shards in one folder
  gyrostat run STUDY.json                          runs what is still missing, and makes the tables
Merging again changes nothing.)";

struct MergeArguments {
  std::string out;
  std::vector<std::string> folders;
  bool mix = false;
};

int run(const MergeArguments& arguments, Console& console) {
  const auto mismatch = arguments.mix ? Mismatch::mix : Mismatch::refuse;
  const auto manifest = Store::open(arguments.folders.front()).manifest();
  make_result_folder(arguments.out);
  for (const auto& folder : arguments.folders)
    if (fs::equivalent(folder, arguments.out))
      throw InputError(folder, "is what is merged into; name the folders of the shards");

  auto store = Store::open_or_create(arguments.out, manifest);
  if (store.manifest().cells.empty()) store.set_cells(manifest.cells);
  for (const auto& folder : arguments.folders) {
    require_same(arguments.out, folder, mismatch);
    console.log << fmt::format("{}: {} new trials\n", folder, store.merge(folder));
  }
  std::uint64_t finished = 0, wanted = 0;
  for (const auto& cell : store.manifest().cells) {
    finished += std::min(cell.finished, cell.trials);
    wanted += cell.trials;
  }
  console.log << fmt::format(
      "{}: {} of {}; gyrostat run STUDY --out {} runs what is missing and "
      "makes the tables\n",
      arguments.out, finished, counted(wanted, "trial"), arguments.out);
  return finished < wanted ? stopped : complete;
}

}  // namespace

void add_merge(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("merge", "put the outcomes of shards together in one folder");
  auto arguments = std::make_shared<MergeArguments>();
  verb->add_option("out", arguments->out, "folder to merge into; made where there is none")
      ->required();
  verb->add_option("folders", arguments->folders, "folders of runs of the same study")->required();
  verb->add_flag("--mix", arguments->mix,
                 "merge outcomes of other builds, or of a study since changed");
  verb->footer(merge_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
