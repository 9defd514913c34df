#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// One kind of recording of a blind check: a scenario, and what was put into it.
struct BlindCase {
  std::vector<std::string> effects;  ///< none, one or two
  std::string strength;              ///< "strong", "medium", ..., empty for none
  Scenario scenario;
  bool has_motion = false;
};

struct BlindCheck {
  std::string title;
  std::uint64_t seed = 1;
  std::uint32_t recordings = 10;  ///< of each case with an effect
  std::uint32_t none_recordings = 40;
  bool left_out = true;  ///< each strong effect is diagnosed without itself, too
  std::vector<BlindCase> cases;
  Json file;  ///< as it was read
};

/// Reads and checks a blind check's file; InputError with the JSON path.
BlindCheck read_blind_check(const std::string& path);

/// Writes the recordings to `folder`/recordings under numbers in an order that tells nothing, with
/// the channels that a recorder has, and their labels to `folder`/sealed_labels.json. What is there
/// already stays; InputError where it is another check's. Throws Interrupted once it is to stop.
void make_recordings(const BlindCheck& check, const std::filesystem::path& folder,
                     const Interrupt& interrupt = {});

/// What a blind check tells while it runs.
struct BlindWatcher {
  std::function<void(std::size_t done, std::size_t of)> progress;
  std::function<void(const std::string& line)> say;
};

/// Runs `program` diagnose on every recording of `folder` in a process of its own, which is given
/// the recording alone; finished ones are not run again. False when it was stopped. `watcher` is
/// called from one thread at a time.
bool diagnose_recordings(const BlindCheck& check, const std::filesystem::path& folder,
                         const std::string& program, const BlindWatcher& watcher,
                         const std::atomic<bool>& stop);

}  // namespace gyrostat::gap
