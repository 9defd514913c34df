#pragma once

#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat {

/// The mistakes of an input file, gathered so that its author is told all of them at once.
class Mistakes {
 public:
  /// Runs `work` and keeps the InputError that it may throw. Whether there was no mistake in it,
  /// neither thrown nor noted on the way.
  template <class Work>
  bool attempt(const Work& work) {
    const auto before = lines_.size();
    try {
      work();
    } catch (const InputError& mistake) {
      note(mistake.what());
    }
    return lines_.size() == before;
  }

  /// Notes a mistake; those of the same `key` (by default the line itself) are told once.
  void note(const std::string& line) { note(line, line); }
  void note(const std::string& line, const std::string& key) {
    if (known_.insert(key).second) lines_.push_back(line);
  }

  bool none() const { return lines_.empty(); }
  const std::vector<std::string>& lines() const { return lines_; }

  /// Throws all as one InputError, a line each.
  void raise() const {
    if (none()) return;
    const auto text = fmt::format("{}", fmt::join(lines_, "\n"));
    const auto place = text.find(": ");  // where InputError puts place and problem together again
    throw InputError(text.substr(0, place), text.substr(place + 2));
  }

 private:
  std::vector<std::string> lines_;
  std::set<std::string> known_;
};

}  // namespace gyrostat
