#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// One kind of recording of a blind check: a scenario, and what was put into it.
struct BlindCase {
  std::string scenario_name;
  std::vector<std::string> effects;  ///< that are to be named
  std::string strength;              ///< "strong", "medium", "weak", "mixed"; empty for none
  std::string form;                  ///< where an effect is in a form near its own
  /// Names that are neither right nor wrong: what the sensor has of its own, and what a near form
  /// may be called as well.
  std::vector<std::string> own;
  std::vector<std::string> without;  ///< what the diagnosing simulator lacks
  std::string left_out;              ///< diagnosed once more without this effect, too
  Scenario scenario;
  bool has_motion = false;  ///< what a recorder writes besides time and gyro
  bool has_temperature = true, has_compass = true;
  /// Recordings at rest to put the effects into, one after another; none: the scenario's noise.
  struct RecordedNoise {
    std::string name;  ///< of file and axis
    std::shared_ptr<const std::vector<double>> dps;
  };
  std::vector<RecordedNoise> noises;
  double noise_step_dps = 0.0;  ///< to which they are rounded; 0: they are not
};

/// Recordings with several effects at once, drawn among the single cases of a scenario.
struct BlindSets {
  BlindCase base;
  std::vector<std::size_t> sizes;
  std::vector<std::string> strengths;
  std::uint32_t recordings = 0;  ///< of each size and strength; 0: as many as of each case
  bool left_out = false;         ///< each is diagnosed without one of its effects, too
};

struct BlindCheck {
  std::string title;
  std::uint64_t seed = 1;
  std::uint32_t recordings = 10;  ///< of each case with an effect
  std::uint32_t none_recordings = 40;
  std::vector<BlindCase> cases;
  std::vector<BlindSets> sets;
  std::vector<std::vector<std::string>> never_together;  ///< what excludes what in one sensor
  Json file;                                             ///< as it was read
};

/// Reads and checks a blind check's file; InputError with the JSON path.
BlindCheck read_blind_check(const std::string& path);

/// The signal of a case with the channels that a recorder has.
Series recorded(const BlindCase& c, const Noise& noise);

/// A case for every recording of the check, the sets and the noises drawn from its seed.
std::vector<BlindCase> drawn_cases(const BlindCheck& check);

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
bool diagnose_recordings(const std::filesystem::path& folder, const std::string& program,
                         const BlindWatcher& watcher, const std::atomic<bool>& stop);

}  // namespace gyrostat::gap
