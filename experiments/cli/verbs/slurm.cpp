#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/run/slurm.hpp>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/plugins/plugins.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* slurm_examples = R"(Examples:
  gyrostat slurm STUDY.json --shards 100 --threads 4 --time 02:00:00
  sbatch STUDY.sbatch
  gyrostat merge runs/STUDY runs/STUDY/shard_* && gyrostat run STUDY.json
Without Slurm, with GNU parallel:
  parallel gyrostat run STUDY.json --threads 1 --shard {}/8 ::: 1 2 3 4 5 6 7 8)";

struct SlurmArguments {
  SlurmJob job;
  std::string file;
  std::uint32_t trials = 0;
};

int run(SlurmArguments arguments, Console& console) {
  auto& job = arguments.job;
  const Study study = read_study(job.study);
  job.name = study.name();
  job.study = fs::absolute(job.study).lexically_normal().string();
  job.folder = fs::absolute(job.folder.empty() ? fs::path("runs") / job.name : fs::path(job.folder))
                   .lexically_normal()
                   .string();
  job.program = fs::read_symlink("/proc/self/exe").string();
  if (arguments.trials > 0) job.options = {"--trials", std::to_string(arguments.trials)};
  for (const auto& plugin : added_plugins())
    job.options.insert(job.options.end(),
                       {plugin.is_library ? "--plugin" : "--filter-command", plugin.from});
  auto texts = job.options;
  texts.insert(texts.end(), {job.study, job.folder, job.program});
  for (const auto& path : texts)
    if (std::ranges::any_of(path, [](unsigned char c) { return c < ' ' || c == 127; }))
      throw InputError(printable(path), "has a line break or the like, which a script cannot hold");
  if (job.name.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-") != std::string::npos)
    throw InputError(job.study,
                     "a job is named as its study file: letters, digits, '_', '.' and '-' only");
  const auto file = arguments.file.empty() ? job.name + ".sbatch" : arguments.file;
  write_atomically(file, sbatch_file(job));
  console.log << fmt::format("{}: {} of {} in all; send it with sbatch {}\n", file,
                             counted(static_cast<std::uint64_t>(job.shards), "task"),
                             counted(study.trials(), "trial"), file);
  return complete;
}

}  // namespace

void add_slurm(CLI::App& program, Console& console, int& exit_code) {
  auto* verb =
      program.add_subcommand("slurm", "write a Slurm job array that runs a study in shards");
  auto arguments = std::make_shared<SlurmArguments>();
  auto& job = arguments->job;
  const auto time_limit = CLI::Validator(
      [](const std::string& text) {
        return !text.empty() && text.find_first_not_of("0123456789:-") == std::string::npos
                   ? std::string{}
                   : "'" + text + "' is no time limit; as 02:00:00 or 1-12:00:00";
      },
      "TIME");
  verb->add_option("study", job.study, "study file (JSON)")->required();
  verb->add_option("--shards", job.shards, "tasks of the array")
      ->check(whole(1, 1000000))
      ->capture_default_str();
  verb->add_option("--threads", job.threads, "threads of each task")
      ->check(whole(1, 1024))
      ->capture_default_str();
  verb->add_option("--time", job.time, "time limit of a task, as 02:00:00")->check(time_limit);
  verb->add_option("--trials", arguments->trials, "trials of every cell, instead of the study's")
      ->check(whole(1, most_trials));
  verb->add_option("--out", job.folder, "folder that all tasks see (default: runs/<study>)");
  verb->add_option("--file", arguments->file, "file to write (default: <study>.sbatch)");
  verb->footer(slurm_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
