#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <iostream>

#include "core/error.hpp"
#include "experiments/cli/verbs.hpp"

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
}

}  // namespace

int main(int argc, char** argv) {
  using namespace gyrostat;
  catch_interrupts();
  cli::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0, stop_requested};
  int exit_code = cli::complete;

  CLI::App program{"Monte Carlo robustness studies of MEMS gyroscope error compensation", "gyrostat"};
  program.require_subcommand(1);
  program.set_version_flag("--version", GYROSTAT_VERSION);
  cli::add_run(program, console, exit_code);
  cli::add_fit(program, console, exit_code);
  cli::add_apply(program, console, exit_code);
  cli::add_simulate(program, console, exit_code);
  cli::add_allan(program, console, exit_code);
  cli::add_match(program, console, exit_code);
  cli::add_ledger(program, console, exit_code);
  cli::add_list(program, console, exit_code);
  cli::add_validate(program, console, exit_code);

  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& mistake) {
    std::cerr << "gyrostat: " << mistake.what() << "; see gyrostat --help\n";
    return cli::usage;
  } catch (const InputError& mistake) {
    std::cerr << "gyrostat: " << mistake.what() << '\n';
    return cli::usage;
  } catch (const std::exception& failure) {
    std::cerr << "gyrostat: " << failure.what() << '\n';
    return cli::error;
  }
  return exit_code;
}
