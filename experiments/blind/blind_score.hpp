#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>

namespace gyrostat::gap {

/// Where the answer on a recording is; where the one without the effect that was left out.
using AnswerOf = std::function<std::filesystem::path(std::size_t number, bool left_out)>;

/// Scores answers, shares with 95 % Wilson intervals:
///   aims         every strength: gap seen, named first, all of a set named, in the verdict's set,
///   gap closed,
///                abstained with the effect left out
///   scenarios    the same by scenario, where there is more than one
///   effects      the same by effect, where it is alone, and what it was taken for
///   left_out     what each effect was taken for when it was not in the catalogue
///   sets         recall, precision and exactness of sets, and set_effects the same by effect,
///   where
///                there are any
///   calibration  how far the stated probabilities can be trusted
///   closed       how far the gap closed, and its interval
///   power        named first by effect, strength and length, where there is more than one length
///   lengths      the same over all effects
/// Recordings without an answer are counted in a note.
std::vector<NamedTable> score(const std::string& title, const std::vector<BlindLabel>& labels,
                              const AnswerOf& answer_of);

/// Opens the labels of `folder` and scores its diagnoses.
std::vector<NamedTable> score_recordings(const std::string& title,
                                         const std::filesystem::path& folder);

}  // namespace gyrostat::gap
