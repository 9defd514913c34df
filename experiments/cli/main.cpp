#include <algorithm>
#include <iostream>
#include <sstream>

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>

namespace {

std::atomic<bool> stop_requested{false};

/// The first Ctrl-C asks for an end in good order; a second one ends at once.
void on_interrupt(int /*signal*/) {
  stop_requested = true;
  struct sigaction at_once {};
  at_once.sa_handler = SIG_DFL;
  sigaction(SIGINT, &at_once, nullptr);
  sigaction(SIGTERM, &at_once, nullptr);
}

void catch_interrupts() {
  struct sigaction orderly {};
  orderly.sa_handler = on_interrupt;
  sigaction(SIGINT, &orderly, nullptr);
  sigaction(SIGTERM, &orderly, nullptr);
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
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
  catch_interrupts();
  cli::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0, stop_requested};
  int exit_code = cli::complete;

  CLI::App program{"Monte Carlo robustness studies of MEMS gyroscope error compensation",
                   "gyrostat"};
  program.require_subcommand(1);
  program.set_version_flag("--version", GYROSTAT_VERSION);
  cli::add_verbs(program, console, exit_code);

  try {
    check_verb(program, argc, argv);
    program.parse(argc, argv);
    if (!std::cout.flush()) throw std::runtime_error("the output cannot be written");
  } catch (const CLI::Success& help) {
    return program.exit(help);
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
