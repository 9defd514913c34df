#include <gyrostat/experiments/blind/blind_check.hpp>

#include <chrono>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/experiments/blind/blind_export.hpp>
#include <gyrostat/experiments/blind/blind_score.hpp>
#include <gyrostat/experiments/blind/seal.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* blind_check_examples = R"(Examples:
  gyrostat blind-check CHECK.json
  gyrostat blind-check CHECK.json --recordings 2 --out runs/short
  gyrostat blind-check CHECK.json --export FOLDER         recordings and sealed labels for others; prints the key
  gyrostat blind-check FOLDER --score ANSWERS --key KEY   what others answered
  gyrostat blind-check CHECK.json --tables PAGE && gyrostat publish PAGE)";

struct BlindCheckArguments {
  std::string file;
  std::string folder;
  std::string tables;
  std::string export_folder, answers, key;
  std::uint32_t recordings = 0;
  std::uint64_t seed = 0;
  FormatOption format;
};

enum class Reached { recordings, some_diagnoses, all };

/// How far it came, should Ctrl-C have ended it.
Reached check_blindly(const gap::BlindCheck& check, const std::filesystem::path& folder,
                      Console& console) {
  using Clock = std::chrono::steady_clock;
  const auto& stop = console.stop.orderly(StopSignal::Done::is_kept);
  try {
    gap::make_recordings(check, folder, Interrupt(stop));
  } catch (const Interrupted&) {
    return Reached::recordings;
  }
  const auto program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::optional<Progress> bar;
  const auto start = Clock::now();
  const gap::BlindWatcher watcher{
      .progress =
          [&](std::size_t done, std::size_t of) {
            if (!bar) bar.emplace(console.log, console.log_is_terminal, "blind-check", of);
            const std::chrono::duration<double> elapsed = Clock::now() - start;
            const double left_s =
                elapsed.count() * static_cast<double>(of - done) / static_cast<double>(done);
            bar->set(done, fmt::format("{} of {} diagnoses, {:.0f} s left", done, of, left_s));
          },
      .say = [&](const std::string& line) { console.log << line << '\n'; }};
  return gap::diagnose_recordings(folder, program, watcher, stop) ? Reached::all
                                                                  : Reached::some_diagnoses;
}

/// The check of the file, as the options change it.
gap::BlindCheck check_of(const BlindCheckArguments& arguments) {
  auto check = gap::read_blind_check(arguments.file);
  if (arguments.recordings > 0) {  // a file of sets alone stays one
    if (check.recordings > 0) check.recordings = arguments.recordings;
    for (auto& sets : check.sets) sets.recordings = arguments.recordings;
  }
  return check;
}

void print(const std::vector<NamedTable>& tables, const BlindCheckArguments& arguments,
           Console& console) {
  if (!arguments.tables.empty())
    for (const auto& [name, text] : page_files(tables))
      write_atomically(std::filesystem::path(arguments.tables) / name, text);
  std::vector<Table> shown;
  for (const auto& named : tables) shown.push_back(named.table);
  console.out << render(shown, arguments.format.get());
}

int make_export(const BlindCheckArguments& arguments, Console& console) {
  auto check = check_of(arguments);
  check.seed = arguments.seed > 0 ? arguments.seed : gap::secret_seed();
  const auto key = gap::export_recordings(check, arguments.export_folder);
  console.out << "key " << key << '\n';
  return complete;
}

int run(const BlindCheckArguments& arguments, Console& console) {
  (void)arguments.format.get();
  if (!arguments.tables.empty()) make_result_folder(arguments.tables);
  if (!arguments.export_folder.empty()) return make_export(arguments, console);
  if (!arguments.answers.empty()) {
    print(gap::score_answers(arguments.file, arguments.answers, arguments.key), arguments, console);
    return complete;
  }
  const auto check = check_of(arguments);
  const std::filesystem::path folder =
      arguments.folder.empty()
          ? std::filesystem::path("runs") / std::filesystem::path(arguments.file).stem()
          : std::filesystem::path(arguments.folder);
  const auto reached = check_blindly(check, folder, console);
  if (reached == Reached::recordings) {
    console.log << "stopped early: not all recordings are made, and the same command goes on\n";
    return stopped;
  }
  if (reached == Reached::some_diagnoses)
    console.log << "stopped early: the tables are of the diagnoses that were done, and the same "
                   "command goes on from them\n";
  print(gap::score_recordings(check.title, folder), arguments, console);
  return reached == Reached::all ? complete : stopped;
}

}  // namespace

void add_blind_check(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "blind-check", "diagnose recordings whose effects are sealed, then open the seals and score");
  auto arguments = std::make_shared<BlindCheckArguments>();
  verb->add_option("check", arguments->file,
                   "blind check file (JSON); with --score the folder that was exported")
      ->required();
  verb->add_option("--out", arguments->folder,
                   "folder of recordings, labels and diagnoses (default: runs/<name>)");
  verb->add_option("--recordings", arguments->recordings,
                   "of each effect and strength, instead of the file's")
      ->check(whole(1, most_trials));
  verb->add_option("--tables", arguments->tables,
                   "folder to write the tables to, tables.json and CSV, as a page reads them");
  auto* exported = verb->add_option(
      "--export", arguments->export_folder,
      "new folder for recordings and sealed labels, for others to answer; prints the key");
  verb->add_option("--seed", arguments->seed,
                   "of the exported recordings (default: a secret one, for who knows the check and "
                   "its seed knows the labels)")
      ->check(whole(1, largest_seed))
      ->needs(exported);
  auto* answers =
      verb->add_option("--score", arguments->answers, "folder of answers, a JSON a recording")
          ->excludes(exported);
  auto* key = verb->add_option("--key", arguments->key, "what --export printed")->needs(answers);
  answers->needs(key);
  arguments->format.add_to(verb);
  verb->footer(blind_check_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
