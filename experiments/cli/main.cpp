#include <algorithm>
#include <iostream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>

namespace {

/// A file that is opened must not take the place of a closed standard stream, or what is printed
/// goes into it. What stands there instead can neither be read nor written to.
void fill_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0)
      (void)!open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
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

}  // namespace

int main(int argc, char** argv) {
  using namespace gyrostat;
  fill_standard_streams();
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  cli::StopSignal stop;
  cli::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0, stop};
  int exit_code = cli::complete;

  CLI::App program{"Monte Carlo robustness studies of MEMS gyroscope error compensation",
                   "gyrostat"};
  program.require_subcommand(1);
  program.set_version_flag("--version", GYROSTAT_VERSION);
  cli::add_verbs(program, console, exit_code);

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
    std::cerr << "gyrostat: " << mistake.what() << "; see gyrostat "
              << (verbs.empty() ? "" : verbs.front()->get_name() + " ") << "--help\n";
    return cli::usage;
  } catch (const InputError& mistake) {
    std::istringstream lines(mistake.what());
    for (std::string line; std::getline(lines, line);) std::cerr << "gyrostat: " << line << '\n';
    return cli::usage;
  } catch (const std::exception& failure) {
    std::cerr << "gyrostat: " << failure.what() << '\n';
    return cli::error;
  }
  return exit_code;
}
