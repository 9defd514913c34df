#include <algorithm>
#include <iostream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <signal.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/experiments/cli/plugin_options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/plugins/host.hpp>

namespace {

/// A file that is opened must not take the place of a closed standard stream, or what is printed
/// goes into it. What stands there instead can neither be read nor written to.
void fill_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0)
      (void)!open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// Series of a few megabytes come and go by the thousand; given back to the kernel each time, their
/// pages cost as much as the work on them.
void keep_freed_memory() {
  constexpr int always = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, always);
  mallopt(M_TRIM_THRESHOLD, always);
  mallopt(M_TOP_PAD, 1 << 26);
}

/// What was printed is out. Throws std::runtime_error where it cannot be.
void flush_output() {
  if (!std::cout.flush()) throw std::runtime_error("the output cannot be written");
}

/// A misspelt verb would otherwise be told that an argument was not expected.
void check_verb(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> verbs;
  for (const auto* verb : program.get_subcommands({})) verbs.push_back(verb->get_name());
  if (std::find(verbs.begin(), verbs.end(), argv[1]) == verbs.end())
    throw gyrostat::InputError("command line", gyrostat::unknown_name("verb", argv[1], verbs));
}

/// "; did you mean '--axis'?" for an option that the verb has not; empty for any other mistake.
std::string meant_option(const CLI::App& verb, int argc, char** argv) {
  std::vector<std::string> known;
  for (const auto* option : verb.get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end())
      continue;
    const auto nearest = gyrostat::nearest_name(word, known);
    if (gyrostat::is_misspelling(word, nearest)) return "; did you mean '" + nearest + "'?";
  }
  return "";
}

/// One line of what a file or a caller may have put into it: nothing that a terminal would obey.
std::string harmless(std::string line) {
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return line;
}

/// A line each, but no more than anybody reads.
void print_mistakes(const std::string& mistakes) {
  constexpr std::size_t most = 50;
  std::istringstream lines(mistakes);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    if (count < most) std::cerr << "gyrostat: " << harmless(line) << '\n';
  if (count > most) std::cerr << "gyrostat: and " << count - most << " more\n";
}

}  // namespace

int main(int argc, char** argv) {
  using namespace gyrostat;
  fill_standard_streams();
  keep_freed_memory();
  if (argc == 5 && std::string_view(argv[1]) == host_verb)
    return host_plugin(argv[2], argv[3], argv[4]);
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  cli::StopSignal stop;
  cli::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0, stop};
  int exit_code = cli::complete;

  CLI::App program{"Monte Carlo robustness studies of MEMS gyroscope error compensation",
                   "gyrostat"};
  program.require_subcommand(1);
  program.set_version_flag("--version", GYROSTAT_VERSION);
  cli::add_verbs(program, console, exit_code);
  cli::add_plugin_options(program);

  try {
    check_verb(program, argc, argv);
    try {
      program.parse(argc, argv);
    } catch (const CLI::Success& help) {
      program.exit(help);
    }
    flush_output();
  } catch (const CLI::ParseError& mistake) {
    const auto verbs = program.get_subcommands();
    const bool is_unknown = dynamic_cast<const CLI::ExtrasError*>(&mistake) != nullptr;
    std::cerr << "gyrostat: " << harmless(mistake.what())
              << (is_unknown && !verbs.empty() ? meant_option(*verbs.front(), argc, argv) : "")
              << "; see gyrostat " << (verbs.empty() ? "" : verbs.front()->get_name() + " ")
              << "--help\n";
    return cli::usage;
  } catch (const InputError& mistake) {
    print_mistakes(mistake.what());
    return cli::usage;
  } catch (const std::exception& failure) {
    std::cerr << "gyrostat: " << harmless(failure.what()) << '\n';
    return cli::error;
  }
  return exit_code;
}
