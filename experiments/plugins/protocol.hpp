#pragma once

#include <cstddef>

namespace gyrostat {

/// What gyrostat and the process of a plug-in say to one another, all of it doubles of the machine.
/// A question begins with its kind and a count:
///   start    the parameters follow, `count` of them; no answer
///   block    `count` samples follow, each the numbers of a gyrostat_sample; the answer is `count`
///            and as many gyrostat_steps. A block of none ends the trial.
///   start_other, block_other   the same of a second instance, in a library only
///   apply    of an effect: a mask of channels, the seed in two halves, the trial, the parameters,
///            then `count` values for each channel of the mask; the answer is `count` and as many
///            values for each channel of the mask that the stage changes
/// docs/plugins.md says it to the authors of filters.
namespace protocol {

inline constexpr int version = 1;

inline constexpr double start = 0, block = 1, apply = 2, start_other = 3, block_other = 4;

inline constexpr std::size_t numbers_of_a_sample = 6, numbers_of_a_step = 5;

/// Samples that go together. No filter may tell.
inline constexpr std::size_t samples_of_a_block = 4096;

}  // namespace protocol
}  // namespace gyrostat
