#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace gyrostat {
class Effect;
}

namespace gyrostat::gap {

struct Diagnosis;

/// What came out, in one sentence that needs no statistics.
std::string answer(const Diagnosis& diagnosis);

/// When it did what it never did before or after; empty where nothing is beyond chance.
std::string transient_in_words(const Diagnosis& diagnosis);

/// How much of the gap what has no name closes; empty where nothing.
std::string remainder_in_words(const Diagnosis& diagnosis);

/// How many metrics of the filters came nearer to the recording, and how many moved away from it;
/// empty where nothing was added.
std::string transfer_in_words(const Diagnosis& diagnosis);

/// What to record next, and how surely that decides; empty where nothing is open.
std::string next_in_words(const Diagnosis& diagnosis);

/// The numbers that the answer rests on.
std::string evidence_in_words(const Diagnosis& diagnosis);

/// Where nothing was found: how large what a random walk imitates would have had to be; else empty.
std::string detectable_in_words(const Diagnosis& diagnosis);

/// "amplitude_dps = 0.25 dps, ...", `but` for one field.
std::string parameters_in_words(const Effect& effect,
                                std::optional<std::size_t> but = std::nullopt);

}  // namespace gyrostat::gap
