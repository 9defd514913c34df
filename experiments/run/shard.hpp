#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace gyrostat {

/// One of several parts of a study. Which trials it owns depends on their numbers alone.
struct Shard {
  std::uint32_t index = 1;  ///< from 1 to `count`
  std::uint32_t count = 1;

  bool owns(std::uint32_t trial) const { return trial % count == index - 1; }
  /// How many of the trials 0 … trials - 1 it owns.
  std::uint32_t share_of(std::uint32_t trials) const {
    return trials / count + (trials % count >= index ? 1 : 0);
  }
  /// "shard_2_of_8"
  std::string folder() const;
};

/// From "2/8"; throws InputError otherwise.
Shard parse_shard(const std::string& text);

/// The shard of a task in a Slurm job array; nothing outside of one. Throws InputError where the
/// array has gaps, since ownership would change with them. `environment` is std::getenv.
std::optional<Shard> slurm_shard(const std::function<const char*(const char*)>& environment);

}  // namespace gyrostat
