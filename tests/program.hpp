#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <gyrostat/recordings/temporary_folder.hpp>
#include <gyrostat/tests/places.hpp>

namespace gyrostat {

/// A fresh folder that goes with the test.
class TestFolder : public TemporaryFolder {
 public:
  void write(const std::string& name, std::string_view contents) const {
    std::filesystem::create_directories((path() / name).parent_path());
    std::ofstream(path() / name, std::ios::binary) << contents;
  }

  std::string read(const std::string& name) const {
    std::ifstream file(path() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// Every file below the folder with its bytes, every folder with "/" behind its name.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path())) {
      const auto name = entry.path().lexically_relative(path()).string();  // it may have gone
      if (entry.is_directory())
        files[name + '/'];
      else
        files[name] = read(name);
    }
    return files;
  }
};

/// How a program ended.
struct Ended {
  int exit_code = 0;  ///< minus the signal's number when a signal ended it
  std::string out, err;
  long peak_KiB = 0;  ///< most memory resident
};

/// `gyrostat <arguments>` started in a folder, with nothing to read and nobody at the terminal.
class Program {
 public:
  Program(const std::filesystem::path& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), places::program());
    std::vector<char*> words;
    for (auto& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    const auto out = (output_.path() / "out").string(), err = (output_.path() / "err").string();
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&files, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
    const int failed =
        posix_spawn(&pid_, arguments.front().c_str(), &files, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failed) throw std::runtime_error("cannot start " + arguments.front());
  }
  ~Program() {
    if (pid_ == 0) return;
    send(SIGKILL);
    wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) const { kill(pid_, signal); }
  /// Waits until it has said so on stderr; false where it ended without.
  bool says(std::string_view text) const {
    for (bool has_ended = false;; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
      if (output_.read("err").find(text) != std::string::npos) return true;
      if (has_ended) return false;
      siginfo_t ended{};
      waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT);
      has_ended = ended.si_pid != 0;
    }
  }

  Ended wait() {
    int status = 0;
    rusage usage{};
    wait4(pid_, &status, 0, &usage);
    pid_ = 0;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), output_.read("out"),
            output_.read("err"), usage.ru_maxrss};
  }

 private:
  TestFolder output_;
  pid_t pid_ = 0;
};

inline Ended run_program(const TestFolder& folder, std::vector<std::string> arguments) {
  return Program(folder.path(), std::move(arguments)).wait();
}

}  // namespace gyrostat
