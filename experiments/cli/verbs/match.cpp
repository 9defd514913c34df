#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/pages/matching.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* match_examples = R"(Examples:
  gyrostat match MATCH.json
  gyrostat match MATCH.json --study FOUND.json    and the study at the scenario found)";

struct MatchArguments {
  std::string match;
  std::string study_out;
  int threads = 0;
  FormatOption format;
};

int run(const MatchArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Match match = read_match(arguments.match);
  const auto result = run_match(match, console.log, arguments.threads);
  if (!arguments.study_out.empty())
    write_atomically(arguments.study_out, result.study.dump(2) + '\n');
  console.out << render(match_tables(match, result), format);
  return complete;
}

}  // namespace

void add_match(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "match", "find the scenario behind published numbers, by simulated moments");
  auto arguments = std::make_shared<MatchArguments>();
  verb->add_option("match", arguments->match, "match file (JSON)")->required();
  verb->add_option("--study", arguments->study_out, "write the study at the scenario found");
  verb->add_option("--threads", arguments->threads, "threads (default: all)")
      ->check(whole(1, 1024));
  arguments->format.add_to(verb);
  verb->footer(match_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
